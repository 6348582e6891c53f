// The smallest robots that show what the rooms promise, as MJCF text.
#pragma once

namespace hurcules_test {

// A slide and a hinge without names to look up: no tuples, no actuators.
inline constexpr const char* kPendulum = R"(
<mujoco>
  <compiler angle="radian"/>
  <worldbody>
    <body name="cart">
      <joint name="slide" type="slide" axis="1 0 0" range="-1 2" limited="true"/>
      <geom size="0.1" mass="3"/>
      <body name="bob" pos="0 0 -0.5">
        <joint name="swing" axis="0 1 0" pos="0 0 0.5"/>
        <geom name="ball" size="0.1" mass="1"/>
      </body>
    </body>
  </worldbody>
</mujoco>)";

// An arm of seven hinges on the ground, every joint driven by a motor.
inline constexpr const char* kArm = R"(
<mujoco>
  <compiler angle="radian"/>
  <default><joint range="-2.5 2.5" limited="true"/></default>
  <worldbody>
    <site name="goal" pos="1 0.2 0.5"/>
    <body name="shoulder" pos="0 0 1" euler="0.2 0 0">
      <joint name="j1" axis="0 -1 0"/><geom size="0.05" mass="4"/>
      <body name="roll">
        <joint name="j2" axis="1 0 0"/><geom size="0.05" mass="3"/>
        <body name="upper">
          <joint name="j3" axis="0 0 1"/><geom size="0.04" pos="0 0 -0.15" mass="3"/>
          <body name="elbow" pos="0 0 -0.3">
            <joint name="j4" axis="0 -1 0"/>
            <geom name="forearm" type="capsule" size="0.03" fromto="0 0 0 0 0 -0.2" mass="2"/>
            <body name="roll2" pos="0 0 -0.25">
              <joint name="j5" axis="0 0 1"/><geom size="0.03" mass="1"/>
              <body name="wrist">
                <joint name="j6" axis="0 -1 0"/><geom size="0.03" mass="1"/>
                <body name="hand">
                  <joint name="j7" axis="1 0 0"/><geom size="0.03" pos="0 0 -0.1" mass="1"/>
                  <site name="tip" pos="0.02 0 -0.15" euler="0 0.5 0"/>
                  <camera name="eye" pos="0.05 0 0" euler="0.3 1.7 0"/>
                </body>
              </body>
            </body>
          </body>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator>
    <motor joint="j1" gear="10" forcerange="-5 5"/> <motor joint="j2" gear="10"/>
    <motor joint="j3"/> <motor joint="j4"/> <motor joint="j5"/> <motor joint="j6"/>
    <motor joint="j7"/>
  </actuator>
  <keyframe>
    <key name="home" qpos="0.4 0.2 -0.1 1.2 0.1 0.3 0"/>
    <key name="straight" qpos="0.4 0.2 -0.1 0 0.1 0 0"/>
  </keyframe>
</mujoco>)";

// A floating base with two coupled legs, a trunk, two arms, a head; a loose ball lies beside it.
inline constexpr const char* kTwin = R"(
<mujoco>
  <compiler angle="radian"/>
  <worldbody>
    <body name="ball" pos="1 0 0"><freejoint/><geom size="0.1" mass="5"/></body>
    <body name="base" pos="0 0 0.5">
      <freejoint name="root"/>
      <geom size="0.2" mass="20"/>
      <site name="base_site" pos="0.1 0 0.05" euler="0 0 0.3"/>
      <body name="leg_l" pos="0 0.2 0"><joint name="LKN" axis="0 1 0" range="-1 2" limited="true"/>
        <geom size="0.05" pos="0.2 0 0" mass="3"/><site name="toe_l" pos="0.4 0 0"/></body>
      <body name="leg_r" pos="0 -0.2 0">
        <joint name="RKN" axis="0 -1 0" range="-2 3" limited="true"/>
        <geom size="0.05" pos="0.2 0 0" mass="3"/><site name="toe_r" pos="0.4 0 0"/></body>
      <body name="trunk" pos="0 0 0.2">
        <joint name="HIP" axis="0 1 0" range="-1.5 1.5" limited="true"/>
        <geom size="0.1" pos="0 0 0.3" mass="10"/>
        <body name="chest" pos="0 0 0.3">
          <joint name="WST" axis="0 0 1"/>
          <geom size="0.1" mass="8"/>
          <body name="neck" pos="0 0 0.5">
            <joint name="NKY" axis="0 0 1"/><geom size="0.03" mass="1"/>
            <body name="head"><joint name="NKP" axis="0 1 0"/><geom size="0.08" mass="2"/>
              <camera name="eye" pos="0.1 0 0" xyaxes="0 -1 0 0 0 1"/>
              <site name="gaze" pos="0.1 0 0"/></body></body>
          <body name="sh_l" pos="0 0.25 0.4">
            <joint name="LSP" axis="0 -1 0"/><geom size="0.04" mass="2"/>
            <body name="up_l"><joint name="LSR" axis="1 0 0"/><geom size="0.04" mass="2"/>
              <body name="ua_l"><joint name="LSY" axis="0 0 1"/>
                <geom size="0.04" pos="0 0 -0.2" mass="2"/>
                <body name="fa_l" pos="0 0 -0.4"><joint name="LEB" axis="0 -1 0"/>
                  <geom size="0.03" pos="0 0 -0.2" mass="2"/><site name="hand_l" pos="0 0 -0.5"/>
                </body></body></body></body>
          <body name="sh_r" pos="0 -0.25 0.4">
            <joint name="RSP" axis="0 -1 0"/><geom size="0.04" mass="2"/>
            <body name="up_r"><joint name="RSR" axis="-1 0 0"/><geom size="0.04" mass="2"/>
              <body name="ua_r"><joint name="RSY" axis="0 0 -1"/>
                <geom size="0.04" pos="0 0 -0.2" mass="2"/>
                <body name="fa_r" pos="0 0 -0.4"><joint name="REB" axis="0 -1 0"/>
                  <geom size="0.03" pos="0 0 -0.2" mass="2"/><site name="hand_r" pos="0 0 -0.5"/>
                </body></body></body></body>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator>
    <motor joint="LKN" forcerange="-50 60"/> <motor joint="RKN" gear="3" forcerange="-10 10"/>
    <motor joint="HIP" forcerange="-80 80"/>
  </actuator>
  <custom>
    <numeric name="velocity_limit_LKN" data="0.6"/>
    <numeric name="velocity_limit_RKN" data="0.8"/>
    <numeric name="velocity_limit_HIP" data="0.5"/>
    <tuple name="coordinate_HIP"><element objtype="joint" objname="HIP" prm="1"/></tuple>
    <tuple name="coordinate_KN"><element objtype="joint" objname="LKN" prm="1"/>
      <element objtype="joint" objname="RKN" prm="-2"/></tuple>
    <tuple name="coordinate_WST"><element objtype="joint" objname="WST" prm="1"/></tuple>
    <tuple name="coordinate_NKY"><element objtype="joint" objname="NKY" prm="1"/></tuple>
    <tuple name="coordinate_NKP"><element objtype="joint" objname="NKP" prm="1"/></tuple>
    <tuple name="coordinate_LSP"><element objtype="joint" objname="LSP" prm="1"/></tuple>
    <tuple name="coordinate_LSR"><element objtype="joint" objname="LSR" prm="1"/></tuple>
    <tuple name="coordinate_LSY"><element objtype="joint" objname="LSY" prm="1"/></tuple>
    <tuple name="coordinate_LEB"><element objtype="joint" objname="LEB" prm="1"/></tuple>
    <tuple name="coordinate_RSP"><element objtype="joint" objname="RSP" prm="1"/></tuple>
    <tuple name="coordinate_RSR"><element objtype="joint" objname="RSR" prm="1"/></tuple>
    <tuple name="coordinate_RSY"><element objtype="joint" objname="RSY" prm="1"/></tuple>
    <tuple name="coordinate_REB"><element objtype="joint" objname="REB" prm="1"/></tuple>
  </custom>
</mujoco>)";

// An arm whose shoulder and wrist are ball joints, the former behind a hinge of the same body; a motor about
// each axis.
inline constexpr const char* kBallArm = R"(
<mujoco>
  <compiler angle="radian" autolimits="true"/>
  <option timestep="0.001"/>
  <default><geom contype="0" conaffinity="0"/><motor forcerange="-60 60"/></default>
  <worldbody>
    <body name="shoulder" pos="0 0 1" euler="0.3 0.2 -0.4">
      <joint name="lift" axis="0 1 0" pos="0.1 0 0" range="-1 1" armature="0.1"/>
      <joint name="shoulder" type="ball" pos="0.05 0 0.02" range="0 1.2" damping="0.5" armature="0.05"/>
      <geom name="upper" type="capsule" fromto="0 0 0 0 0 -0.35" size="0.04" mass="2"/>
      <body name="elbow" pos="0 0 -0.35">
        <joint name="elbow" axis="0 1 0" range="-2.4 0"/>
        <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.03" mass="1.2"/>
        <body name="hand" pos="0 0 -0.3" euler="0 0.4 0">
          <joint name="wrist" type="ball" range="0 1.6"/>
          <geom type="box" pos="0.02 0 -0.05" size="0.05 0.02 0.06" mass="0.4"/>
          <site name="tip" pos="0.03 0.01 -0.1" euler="0 0.5 0"/>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator>
    <motor joint="lift"/>
    <motor joint="shoulder" gear="1 0 0"/><motor joint="shoulder" gear="0 2 0"/>
    <motor joint="shoulder" gear="0 0 -1"/>
    <motor joint="elbow"/>
    <motor joint="wrist" gear="0 0 1"/><motor joint="wrist" gear="1 0 0"/><motor joint="wrist" gear="0 1 0"/>
  </actuator>
  <keyframe>
    <key name="bent" qpos="0.1 0.96 0.15 -0.2 0.1 -1.2 0.96 0.05 0.2 -0.1"/>
  </keyframe>
</mujoco>)";

}  // namespace hurcules_test
