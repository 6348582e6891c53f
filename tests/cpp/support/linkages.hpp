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

}  // namespace hurcules_test
