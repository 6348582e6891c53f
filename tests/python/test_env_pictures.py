"""Pictures of cameras as a part of what is observed.

Strategy: Gymnasium's own checker; what is seen against the renderer asked by hand; the same
picture after `set_state`; what a recording keeps; vectors; and wrong names and sizes.
"""

import os
import subprocess
import sys
from pathlib import Path

import gymnasium as gym
import mujoco
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import hurcules
import hurcules_envs  # noqa: F401  registers
from hurcules import cameras
from hurcules.doctor import render_with
from hurcules.rendering import open_renderer
from hurcules_envs.episode_data import Episode
from hurcules_envs.evaluation import evaluate
from hurcules_envs.onnx_file import Graph, write
from hurcules_envs.policy import Policy
from hurcules_envs.recording import record_episode

CAMERAS = ("head_wide", "auxiliary")


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(("name", "parts"), [("Reach-v0", 3), ("Valve-v0", 1)])
def test_pictures_stand_beside_the_observation(name: str, parts: int) -> None:
    env = gym.make(f"Hurcules/{name}", fidelity="fast", cameras=CAMERAS, camera_size=(64, 48))
    check_env(env.unwrapped, skip_render_check=True)
    seen, _ = env.reset(seed=0)
    plain, _ = gym.make(f"Hurcules/{name}", fidelity="fast").reset(seed=0)
    assert len(seen) == parts + len(CAMERAS)
    plain = plain if isinstance(plain, dict) else {"observation": plain}
    assert all(np.array_equal(seen[part], values) for part, values in plain.items())
    for camera in CAMERAS:
        assert seen[camera].shape == (48, 64, 3)
        assert seen[camera].std() > 5.0  # something is to be seen
    assert not np.array_equal(seen["head_wide"], seen["auxiliary"])
    env.close()


def test_a_picture_shows_the_episode_as_it_stands() -> None:
    env = gym.make("Hurcules/Reach-v0", fidelity="kinematic", cameras=("auxiliary",))
    first, _ = env.reset(seed=0)
    state = env.unwrapped.get_state()
    for _ in range(10):
        later, *_ = env.step(np.ones(6, np.float32))
    assert not np.array_equal(later["auxiliary"], first["auxiliary"])
    env.unwrapped.set_state(state)
    assert np.array_equal(env.unwrapped.observe()["auxiliary"], first["auxiliary"])
    env.close()


def test_the_end_of_one_environment_is_not_seen_in_another() -> None:
    """A renderer gave back what had its numbers in the one that had drawn last."""
    one, other = (
        gym.make("Hurcules/Reach-v0", fidelity="kinematic", cameras=CAMERAS) for _ in range(2)
    )
    one.reset(seed=0)
    seen, _ = other.reset(seed=1)
    one.close()
    again = other.unwrapped.observe()
    assert all(np.array_equal(again[camera], seen[camera]) for camera in CAMERAS)
    other.close()


@pytest.mark.parametrize("backend", ["egl", "osmesa"])
def test_an_environment_that_nobody_closes_ends_in_silence(backend: str) -> None:
    if lost := render_with(backend):
        pytest.skip(f"{backend} does not draw here: {lost}")
    program = (
        "import gymnasium, hurcules_envs\n"
        "env = gymnasium.make('Hurcules/Reach-v0', fidelity='kinematic', cameras=['auxiliary'])\n"
        "env.reset(seed=0)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", program],
        env={n: v for n, v in os.environ.items() if n != "PYOPENGL_PLATFORM"}
        | {"MUJOCO_GL": backend},
        capture_output=True,
        text=True,
    )
    assert (done.returncode, done.stderr) == (0, "")


def test_a_recording_keeps_them(tmp_path: Path) -> None:
    env = gym.make(
        "Hurcules/Reach-v0", fidelity="kinematic", cameras=("auxiliary",), max_episode_steps=3
    )
    episode = record_episode(env, lambda env, seen: env.action_space.sample(), 0)
    episode.save(tmp_path / "one.npz")
    pictures = Episode.load(tmp_path / "one.npz").observations["auxiliary"]
    assert pictures.dtype == np.uint8
    assert pictures.shape == (4, 96, 128, 3)
    env.close()


def test_who_acts_on_them_is_judged() -> None:
    """The episodes side by side show what each shows alone, its last picture after its end too."""
    shown = []

    def act(seen):
        shown.append({name: values.copy() for name, values in seen.items()})
        return np.ones((2, 6))

    options = {"fidelity": "kinematic", "cameras": ("auxiliary",), "camera_size": (64, 48)}
    result = evaluate(act, "Reach-v0", 2, seed=5, **options)
    assert (result.episodes, len(shown)) == (2, 100)
    env = gym.make("Hurcules/Reach-v0", **options)
    for i in range(2):
        alone, _ = env.reset(seed=5 + i)
        for seen in shown[:4]:
            assert all(np.array_equal(seen[part][i], values) for part, values in alone.items())
            alone, *_ = env.step(np.ones(6, np.float32))
    env.close()


def test_a_policy_that_sees_them_fits(tmp_path: Path) -> None:
    env = gym.make("Hurcules/Reach-v0", fidelity="kinematic", cameras=("auxiliary",))

    def sees(size: int) -> Policy:
        inputs = {"observation": 18, "auxiliary": size}
        write(tmp_path / "a.onnx", Graph((), {}, inputs, {"action": 6}))
        return Policy(tmp_path / "a.onnx")

    sees(3).check("Reach-v0", env.observation_space, env.action_space)
    with pytest.raises(hurcules.Error, match=r"got .*auxiliary \(128\); pictures are \(n, height"):
        sees(128).check("Reach-v0", env.observation_space, env.action_space)


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"cameras": "head_wide"}, "cameras: wanted a sequence of names, got 'head_wide'"),
        ({"cameras": ("nose",)}, "camera 'nose' does not exist; there are: overview"),
        ({"cameras": ("head_wide",) * 2}, "cameras: wanted names, each once"),
        ({"cameras": ("head_wide",), "camera_size": 5}, "camera_size: wanted .width, height. of"),
        ({"camera_size": (64, 48)}, "camera_size=.64, 48. wants cameras="),
        ({"camera_size": 5}, "camera_size=5 wants cameras="),
        ({"width": 0}, "width and height: wanted 1 to 2048 pixels each, got 0 and 368"),
        ({"height": 2.5}, "width and height: wanted 1 to 2048 pixels"),
        ({"cameras": ("head_wide",), "camera_size": (0, 9)}, "camera_size: wanted .width, height."),
    ],
)
def test_what_is_no_camera_is_refused(options: dict, says: str) -> None:
    with pytest.raises(hurcules.Error, match=says):
        gym.make("Hurcules/Reach-v0", fidelity="kinematic", **options)


@pytest.mark.parametrize("name", ["Reach-v0", "Valve-v0"])
def test_a_native_vector_observes_pictures(name: str) -> None:
    options = {"fidelity": "fast", "cameras": CAMERAS, "camera_size": (64, 48)}
    vector = gym.make_vec(f"Hurcules/{name}", num_envs=2, **options)
    singles = [gym.make(f"Hurcules/{name}", **options) for _ in range(2)]
    seen, _ = vector.reset(seed=3)
    alone = [single.reset(seed=3 + i)[0] for i, single in enumerate(singles)]
    for _ in range(3):
        assert seen in vector.observation_space
        for i, one in enumerate(alone):
            assert all(np.array_equal(seen[part][i], values) for part, values in one.items())
        actions = vector.action_space.sample()
        before = seen["head_wide"].copy(), seen["head_wide"]
        seen, *_ = vector.step(actions)
        assert np.array_equal(*before)  # nothing is drawn over
        alone = [single.step(a)[0] for single, a in zip(singles, actions, strict=True)]
    vector.close()
    for single in singles:
        single.close()


def test_an_episode_that_ends_shows_its_last_picture_and_the_first_of_the_next() -> None:
    vector = gym.make_vec(
        "Hurcules/Reach-v0", num_envs=2, fidelity="kinematic", cameras=("auxiliary",),
        max_episode_steps=3, autoreset_mode="SameStep", camera_size=(64, 48),
    )  # fmt: skip
    single = gym.make(
        "Hurcules/Reach-v0", fidelity="kinematic", cameras=("auxiliary",), camera_size=(64, 48)
    )
    vector.reset(seed=0)
    vector.reset(options={"reset_mask": np.array([True, False])}, seed=[5, None])
    single.reset(seed=5)
    action = np.full((2, 6), 0.5, np.float32)
    for _ in range(3):
        seen, _, _, cut, info = vector.step(action)
        last, *_ = single.step(action[0])
    assert cut.all()
    first, _ = single.reset()
    assert np.array_equal(info["final_obs"][0]["auxiliary"], last["auxiliary"])
    assert np.array_equal(seen["auxiliary"][0], first["auxiliary"])
    vector.close()
    single.close()


def test_a_native_vector_draws_what_the_single_ones_do() -> None:
    options = {"fidelity": "kinematic", "render_mode": "rgb_array"}
    vector = gym.make_vec("Hurcules/Reach-v0", num_envs=2, **options)
    vector.reset(seed=3)
    vector.step(np.ones((2, 6), np.float32))
    pictures = vector.render()
    assert len(pictures) == 2
    for i, picture in enumerate(pictures):
        single = gym.make("Hurcules/Reach-v0", **options)
        single.reset(seed=3 + i)
        single.step(np.ones(6, np.float32))
        assert np.array_equal(single.render(), picture)
        single.close()
    assert not np.array_equal(*pictures)
    vector.close()
    with pytest.raises(hurcules.Error, match="render mode 'human' does not exist"):
        gym.make_vec("Hurcules/Reach-v0", num_envs=2, render_mode="human")


def test_what_is_pictured_can_be_drawn_as_depth_and_segmentation() -> None:
    """The model of the physics has no visual parts and no lights: its depth is another one."""
    env = gym.make("Hurcules/Reach-v0", fidelity="kinematic", cameras=CAMERAS, camera_size=(64, 48))
    with pytest.raises(gym.error.ResetNeeded):
        _ = env.unwrapped.pictured
    env.reset(seed=0)
    for _ in range(10):
        seen, *_ = env.step(np.full(6, 0.5, np.float32))
    model, data = env.unwrapped.pictured
    with open_renderer(model, 64, 48) as renderer:
        renderer.scene.flags[mujoco.mjtRndFlag.mjRND_SHADOW] = 0
        renderer.update_scene(data, "head_wide")
        assert np.array_equal(renderer.render(), seen["head_wide"])
        renderer.enable_segmentation_rendering()
        renderer.update_scene(data, "head_wide")
        kinds = renderer.render()
    floor = kinds[..., 0] == model.geom("floor").id
    depth = cameras.picture(model, data, "head_wide", depth=True, size=(64, 48))
    # the rays through the pixels of the floor meet it where the depth says
    eye, axes = data.cam("head_wide").xpos, data.cam("head_wide").xmat.reshape(3, 3)
    field = np.tan(np.radians(model.cam("head_wide").fovy[0]) / 2)
    y, x = np.nonzero(floor)
    across, up = (x + 0.5 - 32) / 24 * field, -(y + 0.5 - 24) / 24 * field
    ways = np.stack([across, up, -np.ones(len(x))], axis=1) @ axes.T
    near = depth[y, x] < 5.0
    assert near.sum() > 500
    heights = (eye + depth[y, x, None] * ways)[near, 2]
    assert np.abs(heights - heights[0]).max() < 0.02
    env.close()


@pytest.mark.skipif(bool(render_with("egl")), reason="EGL does not draw here")
def test_another_thread_is_told_who_draws(tmp_path: Path) -> None:
    """It got `EGLError(err=EGL_BAD_ACCESS, ...)`."""
    program = (
        "from concurrent.futures import ThreadPoolExecutor\n"
        "import gymnasium, hurcules_envs, numpy\n"
        "env = gymnasium.make('Hurcules/Reach-v0', fidelity='kinematic', cameras=['auxiliary'])\n"
        "env.reset(seed=0)\n"
        "step = lambda: env.step(numpy.zeros(6, 'float32'))[0]['auxiliary'].shape\n"
        "with ThreadPoolExecutor(1) as pool:\n"
        "    try:\n"
        "        pool.submit(step).result()\n"
        "    except Exception as error:\n"
        "        print(type(error).__name__, error)\n"
        "print(step())\n"
        "env.close()\n"
    )
    rest = {name: value for name, value in os.environ.items() if name != "PYOPENGL_PLATFORM"}
    done = subprocess.run(
        [sys.executable, "-c", program],
        cwd=tmp_path,
        env=rest | {"MUJOCO_GL": "egl"},
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr
    told, shape = done.stdout.splitlines()
    assert told.startswith("RendererError pictures are drawn by the thread that drew the first one")
    assert shape == "(96, 128, 3)"


@pytest.mark.skipif(sys.platform != "linux", reason="no fork")
@pytest.mark.parametrize("threads", [None, "0"])
def test_a_fork_of_a_process_that_drew_does_not_hang(threads: str | None, tmp_path: Path) -> None:
    """Workers of Gymnasium's Async waited for ever for Mesa's threads, which they do not have."""
    program = (
        "import gymnasium, hurcules_envs\n"
        "options = dict(cameras=['auxiliary'], fidelity='kinematic')\n"
        "env = gymnasium.make('Hurcules/Reach-v0', **options)\n"
        "env.reset(seed=0)\n"
        "mode = dict(vectorization_mode='async', vector_kwargs=dict(context='fork'))\n"
        "vector = gymnasium.make_vec('Hurcules/Reach-v0', num_envs=1, **mode, **options)\n"
        "try:\n"
        "    print(vector.reset(seed=0)[0]['auxiliary'].shape)\n"
        "except Exception as error:\n"
        "    print(type(error).__name__, error)\n"
        "vector.close()\n"
        "env.close()\n"
    )
    rest = {n: v for n, v in os.environ.items() if n not in ("PYOPENGL_PLATFORM", "LP_NUM_THREADS")}
    done = subprocess.run(
        [sys.executable, "-c", program],
        cwd=tmp_path,
        env=rest | ({"LP_NUM_THREADS": threads} if threads else {}),
        capture_output=True,
        text=True,
        timeout=120,
    )
    said = "(1, 96, 128, 3)" if threads else "RendererError this process was forked from one that"
    assert done.stdout.startswith(said), done.stderr


@pytest.mark.parametrize("vector", [False, True])
def test_a_view_has_the_size_that_is_asked_for(vector: bool) -> None:
    options = {"fidelity": "kinematic", "render_mode": "rgb_array", "width": 320, "height": 200}
    env = (
        gym.make_vec("Hurcules/Reach-v0", 2, vectorization_mode="vector_entry_point", **options)
        if vector
        else gym.make("Hurcules/Reach-v0", **options)
    )
    env.reset(seed=0)
    pictures = env.render() if vector else (env.render(),)
    assert [one.shape for one in pictures] == [(200, 320, 3)] * (1 + vector)
    env.close()
