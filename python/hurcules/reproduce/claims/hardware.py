"""H01 to H19: the hardware, on the models.

Those without expected numbers are not measured yet: write the numbers here and a function a claim
in measures/.
"""

from hurcules.reproduce.claim import Claim, exactly, most, near

__all__ = ["HARDWARE"]

HARDWARE = (
    Claim(
        "H01",
        "Table 4.1",
        "The robot weighs 680 kg in both configurations.",
        {
            "manipulation": near("mass, manipulation", 680.0, 0.5, "kg", thesis="680 kg"),
            "rescue": near("mass, rescue", 680.0, 0.5, "kg", thesis="680 kg"),
        },
    ),
    Claim(
        "H02",
        "Table 4.1, §4.3",
        "Standing 1.9 m, driving 1.678 m high.",
        {
            "manipulation_ready": near("standing, manipulation", 1.9, 5e-3, "m", thesis="1.9 m"),
            "rescue_ready": near("standing, rescue", 1.9, 5e-3, "m", thesis="1.9 m"),
            "manipulation_drive": near("driving, manipulation", 1.678, 5e-3, "m", thesis="1.678 m"),
            "rescue_drive": near("driving, rescue", 1.678, 5e-3, "m", thesis="1.678 m"),
        },
    ),
    Claim(
        "H03",
        "Table 4.1, §4.3",
        "19 degrees of freedom under RHQP for manipulation, 13 for rescue: 7 or 4 an arm, two of "
        "the neck, "
        "waist, hip and knee.",
        {
            "manipulation": exactly("coordinates, manipulation", 19, thesis="19"),
            "rescue": exactly("coordinates, rescue", 13, thesis="13"),
            "manipulation_arm": exactly("of an arm, manipulation", 7, thesis="7"),
            "rescue_arm": exactly("of an arm, rescue", 4, thesis="4"),
            "neck": exactly("of the neck", 2, thesis="2"),
            "body": exactly("waist, hip and knee", 3, thesis="3"),
        },
    ),
    Claim(
        "H04",
        "Table 4.1, Fig. 4.4 a",
        "Lifts 120 kg from the ground to the carrying pose without saturating a joint's torque "
        "or tipping over.",
    ),
    Claim("H05", "Fig. 4.4 b", "30 kg in each hand, at the carrying pose and at reach."),
    Claim("H06", "§4.2.2", "20 km/h on the flat, within the limits of torque and power."),
    Claim("H07", "§4.2.2", "Climbs and holds on a slope of 30 degrees, with and without load."),
    Claim("H08", "§4.2.2", "CVT: 3:1 at launch to 1:1 at speed, monotone."),
    Claim("H09", "§4.2.2", "Turns in place: 360 degrees with a small drift of the centre of mass."),
    Claim("H10", "§4.2.2", "Glides over small obstacles and crosses trenches."),
    Claim(
        "H11",
        "§4.2.2",
        "Springs of legs and bed lower the vertical acceleration at 20 km/h against a rigid mount.",
    ),
    Claim("H12", "§4.2.3", "Brakes hold the arms without motor power, on bumps too."),
    Claim("H13", "§4.2.3, §4.5", "Two hours on one battery for the scenario of the field tests."),
    Claim(
        "H14",
        "§4.2.3, §4.5",
        "The passive elbow spring lowers the peak of the contact force against a rigid arm, with "
        "small "
        "deviations only.",
    ),
    Claim("H15", "§4.5", "The force estimated from the spring's deflection is the contact force."),
    Claim("H16", "§4.2.1", "The bed expands by itself; attaching or detaching it changes limits."),
    Claim(
        "H17",
        "§2.2, §4.2.4",
        "The whole loop at 1 kHz, the solver below 1 ms in the worst case. Three runs of the "
        "mission stretch "
        "with the same bits; the time of a tick is the smallest of the three, since what another "
        "program "
        "takes away hits other ticks.",
        {
            "solve": most("worst solve", 1.0, "ms", thesis="1 ms"),
            "tick": most("worst control tick", 1.0, "ms", thesis="1 ms"),
        },
    ),
    Claim("H18", "§4.2.1", "Look and move: from an object's pose to a grasp by itself."),
    Claim("H19", "§4.2.1", "Monitors of self-collision and centre of mass run beside RHQP."),
)
