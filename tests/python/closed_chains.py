"""A robot whose joints close a loop, for more than one test."""

FIVE_BAR = """<mujoco><compiler angle="radian"/>
<default><joint axis="0 1 0"/>
<geom type="capsule" size="0.02" contype="0" conaffinity="0"/></default><worldbody>
<body pos="-.15 0 0"><joint name="left"/><geom fromto="0 0 0 0 0 .3"/>
<body name="one" pos="0 0 .3"><joint/><geom fromto="0 0 0 .15 0 .3"/>
<site name="hand" pos=".15 0 .3"/></body></body>
<body pos=".15 0 0"><joint name="right"/><geom fromto="0 0 0 0 0 .3"/>
<body name="two" pos="0 0 .3"><joint/><geom fromto="0 0 0 -.15 0 .3"/></body></body></worldbody>
<equality><connect body1="one" body2="two" anchor=".15 0 .3"/></equality>
<actuator><motor joint="left"/><motor joint="right"/></actuator></mujoco>"""
