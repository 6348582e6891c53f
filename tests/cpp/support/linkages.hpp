// Robots whose passive joints follow the driven ones.
#pragma once

namespace hurcules_test {

// a shoulder, then a parallelogram that is none: crank 0.2 m, coupler 0.45 m, rocker 0.3 m
inline constexpr const char* kFourBar = R"(
<mujoco>
  <compiler angle="radian" autolimits="true"/>
  <default><geom contype="0" conaffinity="0"/></default>
  <worldbody>
    <body name="base" pos="0 0 1">
      <joint name="shoulder" axis="0 0 1"/><geom size="0.05" mass="1"/>
      <body name="crank">
        <joint name="crank" axis="0 1 0"/>
        <geom type="capsule" fromto="0 0 0 0 0 0.2" size="0.02" mass="0.5"/>
        <body name="coupler" pos="0 0 0.2">
          <joint name="elbow" axis="0 1 0"/>
          <geom type="capsule" fromto="0 0 0 0.45 0 0" size="0.02" mass="0.7"/>
          <body name="hand" pos="0.55 0 0">
            <joint name="wrist" axis="0 1 0"/>
            <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02" mass="0.4"/>
            <site name="tip" pos="0.2 0.1 0.05"/>
          </body>
        </body>
      </body>
      <body name="rocker" pos="0.4 0 0">
        <joint name="rocker" axis="0 1 0" range="-0.9 0.9"/>
        <geom type="capsule" fromto="0 0 0 0.05 0 0.2958" size="0.02" mass="0.5"/>
      </body>
    </body>
  </worldbody>
  <equality><connect body1="coupler" body2="rocker" anchor="0.45 0 0"/></equality>
  <actuator><motor joint="shoulder"/><motor joint="crank"/><motor joint="wrist"/></actuator>
</mujoco>)";

// a knee that a rod between two balls drives: the shin follows a crank in the hip
inline constexpr const char* kRod = R"(
<mujoco>
  <compiler angle="radian" autolimits="true"/>
  <default><geom contype="0" conaffinity="0"/></default>
  <worldbody>
    <body name="thigh" pos="0 0 1">
      <joint name="hip" axis="0 1 0"/>
      <geom type="capsule" fromto="0 0 0 0 0 -0.4" size="0.03" mass="2"/>
      <body name="crank">
        <joint name="crank" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 0.08 0 0" size="0.01" mass="0.2"/>
        <body name="rod" pos="0.08 0.02 0">
          <joint name="ball" type="ball"/>
          <geom type="capsule" fromto="0 0 0 0 0 -0.4" size="0.008" mass="0.1"/>
        </body>
      </body>
      <body name="shin" pos="0 0 -0.4">
        <joint name="knee" axis="0.1 1 0"/>
        <geom type="capsule" fromto="0 0 0 0 0 -0.4" size="0.03" mass="1"/>
        <site name="tip" pos="0.03 0 -0.4"/>
      </body>
    </body>
  </worldbody>
  <equality><connect body1="rod" body2="shin" anchor="0 0 -0.4"/></equality>
  <actuator><motor joint="hip"/><motor joint="crank"/></actuator>
</mujoco>)";

// one joint follows along a curve, another by a tendon over two joints
inline constexpr const char* kCurve = R"(
<mujoco>
  <compiler angle="radian" autolimits="true"/>
  <default><geom contype="0" conaffinity="0"/></default>
  <worldbody>
    <body pos="0 0 1"><joint name="a" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.02" mass="1"/>
      <body pos="0 0 -0.3"><joint name="b" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 0 0 -0.2" size="0.02" mass="1"/>
        <body pos="0 0 -0.2"><joint name="c" axis="1 0 0"/><geom type="capsule" fromto="0 0 0 0 0 -0.2" size="0.02" mass="1"/>
          <site name="tip" pos="0 0 -0.2"/></body></body></body>
  </worldbody>
  <tendon><fixed name="t"><joint joint="a" coef="0.7"/><joint joint="c" coef="1.4"/></fixed></tendon>
  <equality>
    <joint joint1="b" joint2="a" polycoef="0.1 0.8 0.5 0 0"/>
    <tendon tendon1="t" polycoef="0.2 0 0 0 0"/>
  </equality>
  <actuator><motor joint="a"/></actuator>
</mujoco>)";

// a crank and a rod on the ground push a piston that slides on the ground: three trees of bodies, the
// tip on one that no coordinate's tree holds
inline constexpr const char* kPiston = R"(
<mujoco>
  <compiler angle="radian" autolimits="true"/>
  <default><geom contype="0" conaffinity="0"/></default>
  <worldbody>
    <body name="crank" pos="0 0 1">
      <joint name="crank" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 0 0 0.2" size="0.02" mass="0.5"/>
      <body name="rod" pos="0 0 0.2">
        <joint name="rod" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 0.5 0 -0.2" size="0.02" mass="0.7"/>
      </body>
    </body>
    <body name="piston" pos="0.5 0 1">
      <joint name="piston" type="slide" axis="1 0 0.3"/><geom size="0.05" mass="0.5"/>
      <body name="lever" pos="0 0 0.1">
        <joint name="lever" axis="0 0 1"/><geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02" mass="0.4"/>
        <site name="tip" pos="0.2 0.1 0.05"/>
      </body>
    </body>
  </worldbody>
  <equality><connect body1="rod" body2="piston" anchor="0.5 0 -0.2"/></equality>
  <actuator><motor joint="crank"/><motor joint="lever"/></actuator>
</mujoco>)";

// a chain of crank, coupler and rocker whose end is tied to a place in the world
inline constexpr const char* kTied = R"(
<mujoco>
  <compiler angle="radian" autolimits="true"/>
  <default><geom contype="0" conaffinity="0"/></default>
  <worldbody>
    <body name="crank" pos="0 0 1">
      <joint name="crank" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 0 0 0.2" size="0.02" mass="0.5"/>
      <body name="coupler" pos="0 0 0.2">
        <joint name="elbow" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 0.4 0 0.1" size="0.02" mass="0.7"/>
        <site name="tip" pos="0.2 0.1 0.05"/>
        <body name="rocker" pos="0.4 0 0.1">
          <joint name="rocker" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 0.05 0 -0.3" size="0.02" mass="0.5"/>
        </body>
      </body>
    </body>
  </worldbody>
  <equality><connect body1="rocker" anchor="0.05 0 -0.3"/></equality>
  <actuator><motor joint="crank"/></actuator>
</mujoco>)";

// an arm carries a box that is welded to its hand and free otherwise
inline constexpr const char* kLoad = R"(
<mujoco>
  <compiler angle="radian" autolimits="true"/>
  <default><geom contype="0" conaffinity="0"/></default>
  <worldbody>
    <body name="upper" pos="0 0 1">
      <joint name="a" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02" mass="1"/>
      <body name="hand" pos="0.3 0 0">
        <joint name="b" axis="0 0 1"/><geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02" mass="0.5"/>
      </body>
    </body>
    <body name="box" pos="0.6 0 1">
      <freejoint name="box"/><geom type="box" size="0.1 0.05 0.08" mass="3"/><site name="tip" pos="0.1 0.05 0"/>
    </body>
  </worldbody>
  <equality><weld body1="hand" body2="box"/></equality>
  <actuator><motor joint="a"/><motor joint="b"/></actuator>
</mujoco>)";

// a planar arm of three driven joints whose hand is welded to a door: one of the four joints leads
inline constexpr const char* kDoor = R"(
<mujoco>
  <compiler angle="radian" autolimits="true"/>
  <default><geom contype="0" conaffinity="0"/></default>
  <worldbody>
    <body name="upper" pos="0 0 1"><joint name="a" axis="0 0 1"/><geom type="capsule" fromto="0 0 0 0.3 0.2 0" size="0.02" mass="1"/>
      <body pos="0.3 0.2 0"><joint name="b" axis="0 0 1"/><geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02" mass="1"/>
        <body name="hand" pos="0.3 0 0"><joint name="c" axis="0 0 1"/><geom size="0.04" mass="0.5"/><site name="tip"/></body></body></body>
    <body name="door" pos="0.6 -0.5 1"><joint name="door" axis="0 0 1" range="-1.5 0.4"/><geom type="box" pos="0 0.4 0" size="0.02 0.4 0.6" mass="8"/></body>
  </worldbody>
  <equality><weld name="grip" body1="hand" body2="door"/></equality>
  <actuator><motor joint="a"/><motor joint="b"/><motor joint="c"/></actuator>
</mujoco>)";

// an arm on a driven ball joint lifts a piston by a rod that follows
inline constexpr const char* kBallRod = R"(
<mujoco>
  <compiler angle="radian" autolimits="true"/>
  <default><geom contype="0" conaffinity="0"/></default>
  <worldbody>
    <body name="arm" pos="0 0 1">
      <joint name="shoulder" type="ball" armature="0.01"/>
      <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02" mass="1"/>
      <body name="rod" pos="0.3 0 0">
        <joint name="rod_x" axis="1 0 0"/><joint name="rod_y" axis="0 1 0"/>
        <geom type="capsule" fromto="0 0 0 0 0 -0.5" size="0.02" mass="0.2"/>
      </body>
    </body>
    <body name="piston" pos="0.3 0 0.5">
      <joint name="piston" type="slide" axis="0.1 0 1"/><geom size="0.05" mass="0.5"/>
      <site name="tip" pos="0.1 0.05 0"/>
    </body>
  </worldbody>
  <equality><connect body1="rod" body2="piston" anchor="0 0 -0.5"/></equality>
  <actuator>
    <motor joint="shoulder" gear="1 0 0"/><motor joint="shoulder" gear="0 1 0"/><motor joint="shoulder" gear="0 0 1"/>
  </actuator>
</mujoco>)";

}  // namespace hurcules_test
