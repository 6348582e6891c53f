"""Episodes recorded as data sets: replayed bit for bit, stopped and gone on with.

Strategy: two episodes of a fast environment in each format, opened by the format's own library and
replayed by their actions alone. A format whose library is not installed is skipped.
Not tested: what is learnt from them (docs/environments.md).
"""

import json
import resource
import signal
import warnings
from contextlib import closing
from itertools import count
from pathlib import Path

import gymnasium as gym
import mujoco
import numpy as np
import pytest

import hurcules
from hurcules.cli import main
from hurcules_envs import recording
from hurcules_envs.data_formats import FORMATS, Format, _robot_type
from hurcules_envs.endings import Ending
from hurcules_envs.episode_data import Episode, Recording
from hurcules_envs.onnx_file import Graph, write
from hurcules_envs.stretch import StretchEnv

NAME = "Hurcules/Drive-v0"
FAST = {"fidelity": "kinematic"}


def expert(env, _):
    return env.environment.expert(env.numbers)[0]


@pytest.fixture
def plain(monkeypatch):
    """A format that wants no package, and the episodes that it was given last."""
    given = []

    def write(_recording, _env, episodes, out):
        given[:] = episodes
        out.mkdir()
        (out / "data").write_text("")

    form = Format(("json", ""), lambda one: "data", write)
    monkeypatch.setitem(recording.FORMATS, "plain", form)
    return given


def words(form: str, out: Path, *more: str) -> list[str]:
    """The command that records two episodes of the policy that ships."""
    given = ["record", "Drive-v0", "--format", form, "--episodes", "2", "--seed", "3"]
    return [*given, "--policy", "Drive-v0", "--fidelity", "kinematic", "--out", str(out), *more]


def test_the_mission_records_its_own_operator(tmp_path, monkeypatch):
    taken, authors = [], []

    def kept(name, act, *_, check, progress, form, seed, author, source, **options):
        taken.append(options)
        authors.append(author)
        env = gym.make(name, **options).unwrapped
        env.reset(seed=0)
        assert act(env, None).shape == env.action_space.shape
        return name

    monkeypatch.setattr(recording, "record", kept)
    for name in ("Stretch-v0", "Reach-v0"):  # the former has no fidelity to choose
        assert main(["record", name, "--out", str(tmp_path)]) == 0
    assert taken == [{}, {"fidelity": "exact"}]
    given = ["--robot", "manipulation", "--fidelity", "kinematic", "--author", "anna"]
    assert main(["record", "Reach-v0", *given]) == 0
    assert taken[2:] == [{"robot": "manipulation", "fidelity": "kinematic"}]
    assert authors == ["expert", "expert", "anna"]


def test_a_policy_is_recorded_in_the_environment_that_it_was_trained_in(tmp_path, monkeypatch):
    """Its options were left out: increments were recorded as velocities, say."""
    taken = []
    monkeypatch.setattr(recording, "record", lambda name, *_, **given: taken.append(given) or name)
    own = {"environment": NAME, "options": '{"fidelity": "kinematic", "friction": [0.5, 1.0]}'}
    write(tmp_path / "a.onnx", Graph((), {}, {"observation": 15}, {"action": 3}, own))
    assert main(["record", "Drive-v0", "--policy", str(tmp_path / "a.onnx")]) == 0
    assert (taken[0]["friction"], taken[0]["fidelity"]) == ([0.5, 1.0], "exact")


def test_a_data_set_of_minari_gives_the_same_episode(tmp_path, monkeypatch):
    pytest.importorskip("minari", reason="pip install 'hurcules[data]'")
    import minari

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # Minari's own, about what it computes
        identifier = recording.record(NAME, expert, 2, tmp_path, seed=3, **FAST)
        monkeypatch.setenv("MINARI_DATASETS_PATH", str(tmp_path))
        data = minari.load_dataset(identifier)
        with pytest.raises(hurcules.Error, match="exists"):
            recording.record(NAME, expert, 1, tmp_path, **FAST)
    assert data.total_episodes == 2
    env = gym.make(NAME, **FAST)
    for number, episode in enumerate(data):
        observation, _ = env.reset(seed=3 + number)
        for k, action in enumerate(episode.actions):
            assert np.array_equal(
                observation["observation"], episode.observations["observation"][k]
            )
            observation, reward, *_, info = env.step(action)
            assert reward == episode.rewards[k]
            assert info["is_success"] == episode.infos["is_success"][k + 1]


def test_the_stretch_says_what_is_wanted_too(tmp_path, monkeypatch):
    """It had no such text: an AttributeError of Minari and LeRobot once all episodes were there."""

    def write(_recording, env, _episodes, out):
        out.mkdir()
        (out / "data").write_text(env.unwrapped.task_description)

    monkeypatch.setitem(recording.FORMATS, "plain", Format(("json", ""), lambda one: "data", write))
    given = {"form": "plain", "max_episode_steps": 2}
    recording.record("Stretch-v0", lambda env, _: env.operator_action(), 1, tmp_path, **given)
    assert (tmp_path / "data").read_text() == StretchEnv.task_description


def test_pictures_of_minari_are_those_that_were_seen(tmp_path, monkeypatch):
    """It writes JPEG unless it is told not to."""
    minari = pytest.importorskip("minari", reason="pip install 'hurcules[data]'")
    options = {**FAST, "cameras": ["head_wide"], "camera_size": [64, 48], "max_episode_steps": 3}
    seen = []

    def acts(env, observation):
        seen.append(observation["head_wide"])
        return expert(env, observation)

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        identifier = recording.record(NAME, acts, 2, tmp_path, **options)
        monkeypatch.setenv("MINARI_DATASETS_PATH", str(tmp_path))
        data = minari.load_dataset(identifier)
    kept = [episode.observations["head_wide"][:-1] for episode in data]
    assert np.array_equal(np.concatenate(kept), seen)


def test_a_file_of_robomimic_gives_the_same_episode(tmp_path):
    h5py = pytest.importorskip("h5py", reason="pip install h5py")
    assert main(words("robomimic", tmp_path)) == 0
    assert main(words("robomimic", tmp_path)) == 2  # it exists
    env = gym.make(NAME, **FAST)
    with h5py.File(tmp_path / "Drive-v0-policy.hdf5") as file:
        data = file["data"]
        assert json.loads(data.attrs["env_args"])["env_name"] == NAME
        assert data.attrs["total"] == sum(len(demo["actions"]) for demo in data.values())
        for number, demo in enumerate(data.values()):
            observation, _ = env.reset(seed=3 + number)
            for k, action in enumerate(demo["actions"]):
                assert np.array_equal(observation["observation"], demo["obs/observation"][k])
                observation, reward, over, *_ = env.step(action)
                assert (reward, over) == (demo["rewards"][k], bool(demo["dones"][k]))
                assert np.array_equal(observation["desired_goal"], demo["next_obs/desired_goal"][k])
            assert demo.attrs["success"]
        assert file["mask/success"][()].tolist() == [b"demo_0", b"demo_1"]


def test_a_data_set_of_lerobot_gives_the_same_episode(tmp_path):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        pytest.importorskip("lerobot", reason="pip install 'lerobot>=0.4'")
        from lerobot.datasets.lerobot_dataset import LeRobotDataset

        assert main(words("lerobot", tmp_path)) == 0
        assert main(words("lerobot", tmp_path)) == 2  # it exists
        root = tmp_path / "Drive-v0-policy-lerobot"
        data = LeRobotDataset("hurcules/drive", root=root)
        frames = [data[i] for i in range(len(data))]
    about = json.loads((root / "meta" / "hurcules.json").read_text())
    env = gym.make(about["environment"], **about["options"])
    rate = env.unwrapped.environment.rate
    assert (data.num_episodes, data.fps) == (2, rate)
    assert data.meta.robot_type == "rescue"
    assert data.features["observation.state"]["names"][-3:] == ["up_2", "legs", "margin"]
    for number, seed in enumerate(about["seeds"]):
        observation, _ = env.reset(seed=seed)
        episode = [one for one in frames if one["episode_index"] == number]
        assert bool(episode[-1]["next.success"])
        for k, one in enumerate(episode):
            assert one["task"] == env.unwrapped.task_description
            assert one["timestamp"].item() == pytest.approx(k / rate)
            for key, name in (
                ("observation.state", "observation"),
                ("observation.achieved_goal", "achieved_goal"),
                ("observation.environment_state", "desired_goal"),
            ):
                assert np.array_equal(observation[name], one[key].numpy())
            observation, reward, over, cut, _ = env.step(one["action"].numpy())
            assert np.float32(reward) == one["next.reward"].item()
            assert (over or cut) == bool(one["next.done"])


def test_a_data_set_of_lerobot_says_whose_robot_it_is():
    """It said "rescue" of the hands with fingers, and of robots of one's own."""
    for options, wanted in (({}, "manipulation"), ({"robot": "arm.xml"}, "arm.xml")):
        recording = Recording("Hurcules/Valve-v0", 1, 0, "expert", "", options)
        with closing(gym.make(recording.environment)) as env:
            assert _robot_type(recording, env.unwrapped.model) == wanted
    recording = Recording("Own/Arm-v0", 1, 0, "expert", "", {})
    arm = Path(gym.__file__).parent / "envs/mujoco/assets/pusher_v5.xml"
    assert _robot_type(recording, mujoco.MjModel.from_xml_path(str(arm))) is None


def test_a_picture_in_a_file_of_robomimic_is_read_alone(tmp_path):
    """A read of one unpacked parts of twelve."""
    h5py = pytest.importorskip("h5py", reason="pip install h5py")
    seen = np.zeros((14, 96, 128, 3), np.uint8)
    flags, rewards = np.zeros(13, bool), np.zeros(13)
    one = Episode(0, {"eye": seen}, np.zeros((13, 2)), rewards, flags, flags, {"is_success": flags})
    recording = Recording("Own/Arm-v0", 1, 0, "expert", "", {})
    FORMATS["robomimic"].write(recording, None, [one], tmp_path / "whole")
    with h5py.File(next((tmp_path / "whole").iterdir())) as file:
        assert {file[f"data/demo_0/{part}/eye"].chunks for part in ("obs", "next_obs")} == {
            (1, 96, 128, 3)
        }


def test_the_command_records_at_another_rate(tmp_path, plain):
    given = ["--rate", "20", "--episodes", "1", "--format", "plain", "--out", str(tmp_path)]
    assert main(["record", "Drive-v0", "--fidelity", "kinematic", *given]) == 0
    (episode,) = plain
    assert np.diff(episode.infos["time"]) == pytest.approx(0.05)


def test_a_data_set_that_exists_is_told_how_more_are_had(tmp_path, plain):
    (tmp_path / "data").mkdir()
    with pytest.raises(hurcules.Error, match="another folder, and for more episodes the seed aft"):
        recording.record(NAME, expert, 1, tmp_path, form="plain", **FAST)


def test_a_recording_that_was_stopped_goes_on(tmp_path):
    h5py = pytest.importorskip("h5py", reason="pip install h5py")
    whole, stopped = tmp_path / "whole", tmp_path / "stopped"
    path = recording.record(NAME, expert, 2, whole, form="robomimic", **FAST)
    with h5py.File(path) as file:
        steps = len(file["data/demo_0/actions"]) + 5
    acted = []

    def stops(env, seen):
        acted.append(1)
        if len(acted) > steps:
            raise KeyboardInterrupt
        return expert(env, seen)

    with pytest.raises(KeyboardInterrupt):
        recording.record(NAME, stops, 2, stopped, form="robomimic", **FAST)
    assert len(list(stopped.glob("*.part/*.npz"))) == 1
    with pytest.raises(hurcules.Error, match="stopped: seed"):
        recording.record(NAME, expert, 2, stopped, form="robomimic", seed=1, **FAST)
    again = []

    def counts(env, seen):
        again.append(1)
        return expert(env, seen)

    recording.record(NAME, counts, 2, stopped, form="robomimic", **FAST)
    assert [one.name for one in stopped.iterdir()] == [Path(path).name]
    with h5py.File(path) as one, h5py.File(stopped / Path(path).name) as other:
        assert len(again) == len(one["data/demo_1/actions"])  # the first one was kept
        for demo in ("demo_0", "demo_1"):
            for part in ("actions", "rewards", "obs/observation"):
                assert np.array_equal(one[f"data/{demo}/{part}"], other[f"data/{demo}/{part}"])


def test_a_full_disk_keeps_what_was_finished(tmp_path):
    """A limit on the size of files stands for it: first for the data set, then for an episode."""
    pytest.importorskip("h5py", reason="pip install h5py")

    def tried(out: str) -> str:
        return recording.record(NAME, expert, 4, tmp_path / out, form="robomimic", **FAST)

    size = Path(tried("whole")).stat().st_size
    usual = resource.getrlimit(resource.RLIMIT_FSIZE)
    for limit, said, left in (
        (size - 1, r"4 of 4 episodes are kept in .*\.part", [".part"]),
        (2000, r"could not be written: File too large\.$", []),
    ):
        out = f"limit {limit}"
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, usual[1]))
        try:
            with pytest.raises(hurcules.Error, match=said):
                tried(out)
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, usual)
        assert [one.suffix for one in (tmp_path / out).iterdir()] == left
        assert Path(tried(out)).stat().st_size == size


def test_how_many_episodes_succeeded_is_told(tmp_path, plain, capsys):
    """The first is the expert's, the second stands still."""
    told = []

    def stands(env, seen):
        if env.simulation.time == 0.0:
            acting.append(not acting)
        return acting[-1] * expert(env, seen)

    acting: list[bool] = []
    given = {"form": "plain", "progress": lambda *one: told.append(one), **FAST}
    recording.record(NAME, stands, 2, tmp_path / "a", **given)
    assert told == [(0, 0), (1, 1), (2, 1)]
    assert main(words("plain", tmp_path / "b")) == 0
    assert f"{sum(one.success for one in plain)} of 2 episodes succeeded" in capsys.readouterr().out


def test_what_is_recorded_is_what_was_done(tmp_path, plain):
    recording.record(NAME, lambda *_: [3.0, -3.0, 0.0], 1, tmp_path, form="plain", **FAST)
    (one,) = plain
    assert (one.actions == np.float32([1.0, -1.0, 0.0])).all()
    env = gym.make(NAME, **FAST)
    env.reset(seed=0)
    assert [env.step(action)[1] for action in one.actions] == one.rewards.tolist()


def test_who_acts_ends_an_episode_or_begins_it_anew(tmp_path, plain):
    """The first attempt at the first episode does not count, the second one is cut."""
    steps = count(1)

    def person(env, seen):
        step = next(steps)
        if step == 5:
            raise recording.Again
        return None if step == 12 else expert(env, seen)

    recording.record("Drive-v0", person, 2, str(tmp_path), form="plain", **FAST)
    first, second = plain
    assert (first.seed, len(first.actions), first.success) == (0, 6, False)
    assert first.truncated.tolist() == [False] * 5 + [True] and not first.terminated.any()
    assert not first.infos["ending"].any()  # no limit cut it
    assert (second.seed, second.success, bool(second.terminated[-1])) == (1, True, True)
    assert np.array_equal(
        first.actions[0], recording.record_episode(gym.make(NAME, **FAST), expert, 0).actions[0]
    )
    with pytest.raises(hurcules.Error, match="before its first step"):
        recording.record(NAME, lambda *_: None, 1, tmp_path / "none", form="plain", **FAST)
    assert not list((tmp_path / "none").iterdir())


def test_mistakes_are_told_before_anything_is_recorded(tmp_path, plain):
    for given, said in (
        ({"author": "J. Doe / 3"}, "author: wanted letters"),
        ({"act": "expert"}, "act: wanted a function of environment and observation, got 'ex"),
        ({"episodes": 0}, "episodes: wanted a whole number >= 1, got 0"),
        ({"environment": gym.make(NAME, **FAST)}, "environment: wanted an id"),
    ):
        wanted = {"environment": NAME, "act": expert, "episodes": 1, "out": tmp_path} | given
        with pytest.raises(hurcules.Error, match=said):
            recording.record(**wanted, form="plain", **FAST)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ("ReachJoint-v0", "ReachJoint-v0 has no expert for its action"),
        ("Reach-v0 --camera nose", "camera 'nose' does not exist"),
        ("Drive-v0 --policy Drive-v0 --camera nose", "camera 'nose' does not exist"),
        ("Reach-v0 --set colour=red", "option 'colour' does not exist"),
        ("Reach-v0", "this format wants no_such: pip install it"),
    ],
)
def test_a_package_that_is_missing_is_told_last(tmp_path, monkeypatch, capsys, words, told):
    form = Format(("no_such", "it"), lambda one: "data", lambda *_: None)
    monkeypatch.setitem(recording.FORMATS, "minari", form)
    out = ["--fidelity", "kinematic", "--out", str(tmp_path / "data")]
    made: list[str] = []
    make = gym.make
    monkeypatch.setattr(
        gym, "make", lambda *one, **given: made.append(one[0]) or make(*one, **given)
    )
    assert main(["record", *words.split(), *out]) != 0
    said = capsys.readouterr()
    assert told in " ".join(said.err.split())
    assert said.out == ""  # and no bar
    assert len(made) < 2  # one environment for all that is asked of it
    assert not list(tmp_path.iterdir())


def test_options_are_paths_and_arrays_too(tmp_path, plain):
    arm = Path(gym.__file__).parent / "envs/mujoco/assets/pusher_v5.xml"
    given = {"robot": arm, "frames": ("tips_arm",), "observation_noise": np.array([0.0, 0.01])}
    recording.record("Reach-v0", lambda *_: np.zeros(3), 1, tmp_path, form="plain", **FAST, **given)
    assert len(plain) == 1


def test_recorded_episodes_last_as_long_at_any_rate(tmp_path, plain):
    def holds(*_):
        return np.zeros(6)

    for given, steps in (({"rate": 10}, 50), ({"rate": 10, "max_episode_steps": 7}, 7)):
        recording.record("Reach-v0", holds, 1, tmp_path / str(steps), form="plain", **FAST, **given)
        assert len(plain[0].actions) == steps
        ending = plain[0].infos["ending"]  # the wrapper that cuts it tells no info
        assert ending.tolist() == [int(Ending.Running)] * steps + [int(Ending.TimeLimit)]


def test_what_is_kept_is_told_and_never_thrown_away(tmp_path, plain):
    begun = count()

    def unplugged(env, seen):
        if env.simulation.time == 0.0 and next(begun) == 2:
            raise OSError("no such device")
        return expert(env, seen)

    def tried(episodes, act=expert):
        return recording.record(NAME, act, episodes, tmp_path, form="plain", **FAST)

    said = r"^no such device\n2 of 3 episodes are kept in \S+; [\w\s,]{60,80} these alone$"
    with pytest.raises(OSError, match=said):
        tried(3, unplugged)
    with pytest.raises(hurcules.Error, match="holds 2 episodes that are finished, 1 were wanted"):
        tried(1)
    tried(2, unplugged)
    assert [one.seed for one in plain] == [0, 1]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_stop_says_what_is_kept(number, tmp_path, plain, monkeypatch, capsys):
    begun, before = count(), signal.getsignal(number)

    def stops(env, seen):
        # asked once before the recording; 2: the second episode
        if env.simulation.time == 0.0 and next(begun) == 2:
            signal.raise_signal(number)
        return expert(env, seen)

    monkeypatch.setattr("hurcules_envs.command._expert", stops)
    assert (
        main(
            [
                "record",
                "Drive-v0",
                "--fidelity",
                "kinematic",
                "--format",
                "plain",
                "--episodes",
                "3",
                "--out",
                str(tmp_path),
            ]
        )
        == 130
    )
    assert capsys.readouterr().out.count("1 of 3 episodes are kept in") == 1
    assert signal.getsignal(number) is before
    words = r"another recording that was stopped: seed \(there 0, now 1\); delete it"
    with pytest.raises(hurcules.Error, match=words):
        recording.record(NAME, expert, 3, tmp_path, form="plain", seed=1, **FAST)
