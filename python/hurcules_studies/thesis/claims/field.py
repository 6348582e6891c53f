"""F01 to F07: the sequences of the field tests.

Each has a run that must fail: what is too heavy, a person on the front, a waist that is not
turned, arms that are not folded, brakes that are open, tips that press too hard, a neck that is
not turned.
"""

from hurcules_studies.thesis.claim import Claim, exactly, least, most, near

__all__ = ["FIELD"]

FIELD = (
    Claim(
        "F01",
        "§4.5, Fig. 4.27",
        "Ordnance: twelve steps (drive, waist, both legs, stand, four of acquisition, lift and "
        "sit, waist and "
        "right leg, waist and left leg, torso forward and lean).",
        {
            "steps": exactly("steps of the figure, in their order", 12),
            "success": exactly("missions done, 20 kg (docs/disposal.md)", 1),
            "distance": least("nearest that the robot comes to itself", 0.0, "m"),
            "heavy": exactly("missions done with 30 kg on bars of friction 0.4", 0),
        },
        caveat="case, bars and container are ours; the way to them is 1.25 m and 1.8 m",
    ),
    Claim(
        "F02",
        "Fig. 4.28",
        "Casualty: twelve steps, with folded arms, penetration under the body, lift, one leg at "
        "a time, "
        "bed deployed, put down, arms pulled out.",
        {
            "steps": exactly("steps from the approach to the arms out, in their order", 12),
            "success": exactly("missions done, 75 kg (docs/casualty.md)", 1),
            "distance": least(
                "nearest that the robot comes to itself",
                0.0,
                "m",
                figure=True,
                ours=(-1e-3, 0.0),
                why="the scoops rest on the bed as they lay him down",
            ),
            "beside": exactly(
                "missions done with the person 0.5 m beside the arms",
                0,
                figure=True,
                ours=(1, 1),
                why="the robot drives to where he lies: no run that must fail, the next is",
            ),
            "front": exactly("missions done with a person who lies on the front", 0),
        },
        missing="the way from driving to standing in the same run (K19 measures it apart)",
    ),
    Claim(
        "F03",
        "§4.5",
        "No self-collision in any transformation; legs rotated without turned waist and folded "
        "arms do "
        "collide.",
        {
            "all": exactly("pairs of bodies that meet, both robots, up and back", 0),
            "waist": least("the same without a turned waist, the robot with fewer", 1),
            "arms": least("the same without folded arms", 1),
        },
    ),
    Claim(
        "F04",
        "§4.5",
        "Seven missions of 400 m round trip within two hours.",
        {
            "time": most(
                "seven times there, the casualty mission, and back", 2.0, "h", thesis="2 h"
            ),
            "charge": least("charge left", 0.0),
            "way": near("way there, way back, shorter one", 400.0, 2.0, "m", thesis="400 m"),
        },
        caveat="400 m each way, twice the thesis' way if it counts both; the battery's capacity is "
        "assumed (docs/design/robot.md#battery)",
    ),
    Claim(
        "F05",
        "§4.5",
        "Arms without power while driving keep their pose.",
        {
            "shut": most("largest motion of an arm's joint in 50 m at 20 km/h", 0.01, "rad"),
            "torque": exactly("torque of the arms' motors", 0.0, "N m"),
            "open": least("the same with open brakes", 0.1, "rad"),
        },
    ),
    Claim(
        "F06",
        "§4.5",
        "The lower arms go under the casualty; too much friction or contact force blocks it.",
        {
            "under": exactly("arms under a person of 75 kg, friction 0.2, 5 N a tip", 1),
            "push": least("push with friction 2.0, over that with 0.2", 1.5),
            "rough": exactly(
                "the same with blades of friction 2.0",
                0,
                ours=(1, 1),
                why="he is pushed along before the blades, 0.4 m in place of 0.3 m, and then "
                "comes over them: the tracks push as hard as it takes",
            ),
            "pressed": exactly("the same with 100 N a tip", 0),
        },
        caveat="with 100 N a tip nothing holds the arms: the robot stands on them and falls over; "
        "blades of friction 2.0 push him along by 0.40 m, where the mission gives up: it goes "
        "either way with the last digits",
    ),
    Claim(
        "F07",
        "Fig. 4.29",
        "Camera views at lifting-ready, acquisition and lifting.",
        {
            "ready": least(
                "share of the head's picture that shows the person, lifting ready", 0.05
            ),
            "acquisition": least("the same in acquisition", 0.05),
            "lifting": least("the same as the lifting begins", 0.05),
            "arms": least("share that shows the robot itself in acquisition", 0.05),
            "ahead": most("person in the picture of a head that is not turned, most", 0.01),
        },
        caveat="the thesis prints four pictures and no number: the bounds are ours, set after a "
        "first look at what the camera sees",
    ),
)
