"""Test methods: their statistics are exact, their runs repeat, stop where they should, log faults.

Strategy: statistics against the printed table of docs/design/test-methods.md#statistics [C1] and
against draws; runs with few repetitions at settings that geometry decides. Not tested: the largest
settings themselves, which are results.
"""

import dataclasses
import json
import math
import re

import numpy as np
import pytest

import hurcules
from hurcules import cli, scenes
from hurcules_studies import field_tests
from hurcules_studies.field_tests.course import Leg, Oval
from hurcules_studies.field_tests.methods import Way
from hurcules_studies.field_tests.parse import parse, shown

# [C1] minimum n for 0 / 1 / 2 / 3 failures at confidence 80, 85, 90, 95 %
TABLE = {
    0.80: ((8, 14, 21, 27), (9, 16, 23, 29), (11, 18, 25, 32), (14, 22, 30, 37)),
    0.85: ((10, 19, 28, 36), (12, 22, 31, 39), (15, 25, 34, 43), (19, 30, 40, 50)),
    0.90: ((16, 29, 42, 54), (19, 33, 46, 59), (22, 38, 52, 65), (29, 46, 61, 76)),
    0.95: ((32, 59, 85, 110), (37, 67, 94, 119), (45, 77, 105, 132), (59, 93, 124, 153)),
}
# nothing differs, for runs whose outcome is to be certain
SAME = field_tests.Variation(friction=(1.0, 1.0), payload=0.0, offset=0.0, yaw=0.0)


@pytest.mark.parametrize("reliability", TABLE)
def test_the_least_numbers_of_repetitions_are_the_printed_ones(reliability):
    for wanted, row in zip((0.80, 0.85, 0.90, 0.95), TABLE[reliability], strict=True):
        found = tuple(field_tests.repetitions_needed(reliability, wanted, f) for f in range(4))
        assert found == row, wanted


@pytest.mark.parametrize(
    "n, failures, reliability, percent", [(10, 0, 0.80, 89), (30, 0, 0.90, 96), (30, 3, 0.80, 88)]
)
def test_the_printed_examples_come_out(n, failures, reliability, percent):  # [C1]
    assert round(100 * field_tests.confidence(n, failures, reliability)) == percent


def test_confidence_is_the_share_of_draws_with_more_failures():
    draws = np.random.default_rng(2).binomial(20, 1 - 0.8, size=200_000)
    for failures in (0, 2, 5):
        share = (draws > failures).mean()
        assert field_tests.confidence(20, failures, 0.8) == pytest.approx(share, abs=5e-3)


@pytest.mark.parametrize("n, failures", [(10, 0), (30, 3), (100, 40)])
def test_the_lower_bound_has_exactly_the_confidence(n, failures):
    bound = field_tests.lower_bound(n, failures, 0.95)
    assert field_tests.confidence(n, failures, bound) == pytest.approx(0.95, abs=1e-9)
    assert field_tests.lower_bound(n, n) == 0.0


def test_bad_counts_and_shares_are_refused():
    for call in (
        lambda: field_tests.confidence(0, 0, 0.5),
        lambda: field_tests.confidence(5, 6, 0.5),
        lambda: field_tests.confidence(5, 0, 1.5),
        lambda: field_tests.lower_bound(5, -1),
        lambda: field_tests.repetitions_needed(1.0, 0.9),
        lambda: field_tests.run("e2801", repetitions=0),
        lambda: field_tests.run("e2801", speed=0.0),
    ):
        with pytest.raises(hurcules.Error, match="wanted"):
            call()
    with pytest.raises(hurcules.Error, match=r"'e9999' does not exist; .*e2801"):
        field_tests.run("e9999")


@pytest.mark.parametrize("name", field_tests.METHODS)
def test_every_setting_of_a_method_is_a_scene_and_they_get_harder(name):
    method = field_tests.method(name)
    assert list(method.settings) == sorted(method.settings)
    for setting in method.settings or (None,):
        scene = scenes.scene(method.scene, **method.values(setting))
        assert method.way is not Way.ThereAndBack or scene.end > 2.0


def test_a_run_stops_at_the_first_setting_that_is_not_passed_and_says_why():
    result = field_tests.run("e2801", repetitions=1, settings=(0.2, 1.5, 0.3), variation=SAME)
    assert [one.setting for one in result.settings] == [0.2, 1.5]
    assert result.passed and result.largest == 0.2
    good, bad = result.settings
    assert good.failures == 0 and good.metres_per_minute == pytest.approx(
        36, rel=0.08
    )  # starts and stops
    # its tail in the gap, the toes on the near edge
    assert bad.failures == 1 and bad.faults[0].fault == "stuck" and bad.faults[0].x > 2.0
    assert good.confidence_80 == pytest.approx(0.2) and bad.confidence_80 == 0.0
    assert json.loads(json.dumps(result.as_dict()))["settings"][0]["setting"] == 0.2


def test_the_same_seed_gives_the_same_repetition_and_another_differs():
    method = field_tests.Method("", "gap", "width", (0.1,))
    first, again, other = (field_tests.repeat(method, 0.1, "rescue", seed) for seed in (5, 5, 6))
    assert first == again and first.fault == ""
    assert first.seconds != other.seconds or first.x != other.x


def test_too_little_friction_is_a_fault_not_an_error():
    slippery = field_tests.Variation(friction=(0.33, 0.33), payload=0.0)  # 0.3; tan 25 = 0.47
    settings = (math.radians(25),)
    result = field_tests.run("e2803", repetitions=1, settings=settings, variation=slippery)
    assert not result.passed and result.largest is None
    assert result.settings[0].faults[0].fault in ("stuck", "off the lane")


def test_a_lap_at_full_speed_keeps_to_its_lane():
    """This seed left it in the first bend, then on the straight behind it: see docs/drive.md."""
    assert field_tests.repeat(field_tests.METHODS["e2829"], 5.56, "rescue", 5).fault == ""


def test_another_driver_takes_the_place_of_ours():
    calls = []

    def sleeper(model, data, speed):
        calls.append(speed)
        return 0.0, 0.0

    result = field_tests.run("e2801", repetitions=1, settings=(0.1,), driver=sleeper, speed=2.0)
    assert result.settings[0].faults[0].fault == "stuck"
    assert len(calls) > 100 and set(calls) == {-2.0}  # tail first


def test_a_driver_that_writes_torques_is_told_what_is_wanted():
    def torques(model, data, speed):
        data.ctrl[:] = speed

    with pytest.raises(hurcules.Error, match=r"wanted the speed .* got None; the closed loop"):
        field_tests.run("e2801", repetitions=1, settings=(0.1,), driver=torques)


# a sled of so much mass, towed by a little: repetitions of a second
SHORT = dataclasses.replace(field_tests.METHODS["e2831"], distance=0.3)


def test_any_number_of_workers_gives_the_same_result():
    one, two = (
        field_tests.run(SHORT, repetitions=3, settings=(75.0, 120.0), workers=n) for n in (1, 2)
    )
    assert one == two and one.largest == 120.0 and len(one.settings) == 2


def test_a_stop_keeps_what_was_done_and_passes_nothing_that_lacks_repetitions():
    seen = []
    result = field_tests.run(
        SHORT,
        repetitions=3,
        settings=(75.0,),
        progress=lambda *now: seen.append(now),
        stopped=lambda: len(seen) == 2,
    )
    assert seen == [(75.0, 1, 0), (75.0, 2, 0)]
    assert result.interrupted and not result.passed and result.settings[0].repetitions == 2


def push_over(model, data, speed):
    """A driver whose repetitions last a second."""
    data.body("torso").xfrc_applied[0] = 2e4
    return 0.0, 0.0


@pytest.mark.parametrize("workers", [1, 2])
def test_a_setting_that_fails_three_times_from_the_start_is_not_repeated(workers):
    result = field_tests.run(
        SHORT, repetitions=5, settings=(75.0,), workers=workers, driver=push_over
    )
    assert not result.passed and not result.interrupted
    assert {one.fault for one in result.settings[0].faults} == {"tip-over"}
    assert result.settings[0].repetitions == result.settings[0].failures == 3


def test_towing_ends_where_traction_does():
    # 0.5 M g of the sled against at most 0.9 x 700 kg x g of the robot
    result = field_tests.run(SHORT, repetitions=1, settings=(75.0, 2000.0))
    assert result.largest == 75.0
    assert result.settings[1].faults[0].fault == "stuck"


def test_the_command_writes_summary_and_report_and_its_status_tells(tmp_path, capsys, monkeypatch):
    monkeypatch.setitem(field_tests.METHODS, "e2831", SHORT)
    words = ["run", "e2831", "--repetitions", "1", "--no-video", "--out", str(tmp_path)]
    words += ["--friction", "0.4", "--pace", "0.5", "--mass"]
    assert cli.main([*words, "75"]) == 0
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert summary["mission"] == "e2831" and summary["success"] is True
    assert summary["reason"] == "largest setting passed: 75 kg"
    assert {"seed", "version", "simulated_seconds", "real_time_factor"} < set(summary)
    assert summary["parameters"]["friction"] == 0.4 and summary["pace"] == 0.5
    page = (tmp_path / "report.html").read_text()
    assert "hitched sleds" in page and "friction 0.4 · pace 0.5 m/s · seed 0" in page
    assert "Faults" not in page
    assert cli.main([*words, "2000"]) == 2  # the folder holds another run
    assert "mass 75', now '" in capsys.readouterr().err
    words[words.index("--out") + 1] = str(tmp_path := tmp_path / "2000")
    assert cli.main([*words, "2000"]) == 1
    assert json.loads((tmp_path / "summary.json").read_text())["success"] is False
    assert "<h2>Faults</h2>" in (tmp_path / "report.html").read_text()
    assert "1 stuck" in capsys.readouterr().out


def test_options_of_a_method_are_read_in_degrees():
    chosen, settings = parse("e2803", ["--angle", "25,30", "--friction=0.5", "--length", "3"])
    assert settings == (math.radians(25), math.radians(30))
    assert chosen.values(settings[0])["friction"] == 0.5 and chosen.fixed["length"] == 3.0
    assert [shown(chosen, one) for one in settings] == ["25 deg", "30 deg"]
    assert parse("e2803", [])[1] is None
    assert parse("e2829", ["--speed", "5,5.56"])[1] == (5.0, 5.56)


def test_a_robot_without_hands_is_told_before_the_last_results_are_removed(tmp_path, capsys):
    (tmp_path / "summary.json").write_text("{}")
    assert cli.main(["run", "e2830", "--out", str(tmp_path)]) == 2
    assert "e2830: --robot: wanted 'manipulation', which has hands" in capsys.readouterr().err
    assert (tmp_path / "summary.json").read_text() == "{}"


@pytest.mark.parametrize(
    "words, says",
    [
        (["e2803", "--angel", "30"], "no option --angel; the scene 'incline' has: .*angle"),
        (["e2803", "--angle"], "--angle wants a value"),
        (["e2803", "30"], "wanted --PARAMETER VALUE, got '30'"),
        (["e2803", "--angle", "steep"], "--angle: wanted a number, got 'steep'"),
        (["e2803", "--angle", "80"], "--angle: wanted a number from 5 to 45 degrees, got 80"),
        (["e2829", "--speed", "0"], "--speed: wanted a positive number, got '0'"),
        (["e2829", "--pace", "2"], "e2829: the speed is its setting"),
    ],
)
def test_wrong_options_of_a_method_are_one_line_and_exit_code_2(words, says, capsys):
    assert cli.main(["run", *words]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert re.search(says, error)


def test_an_oval_is_as_long_as_it_is_and_its_places_are_right():
    oval = Oval(50.0, 2.0)
    assert oval.length == pytest.approx(100 + 4 * math.pi)
    assert oval.at(10.0, 0.3).offset == pytest.approx(0.3)
    assert oval.at(10.0, 0.3).straight == pytest.approx(40.0)
    far = oval.at(10.0, 4.3)
    assert far.offset == pytest.approx(-0.3) and far.heading == pytest.approx(math.pi)
    bend = oval.at(52.5, 2.0)
    assert bend.offset == pytest.approx(-0.5) and bend.curvature == pytest.approx(0.5)
    assert bend.heading == pytest.approx(math.pi / 2)


def test_a_lap_ends_after_one_turn_round_the_middle():
    leg = Leg(1.0, 0.0, turns=1, centre=(5.0, 2.0))
    angles = np.linspace(-2.0, -2.0 + 2 * math.pi + 0.01, 200)
    done = [leg.done(np.array([5 + math.cos(a), 2 + math.sin(a)])) for a in angles]
    assert not any(done[:-2]) and done[-1]
    assert field_tests.METHODS["e2829"].way is Way.Laps


def test_a_posture_is_taken_and_held_on_the_brakes():
    raised = field_tests.Posture(knee=0.3, hip=0.2)

    def plan(_: object) -> field_tests.Plan:
        return lambda x: raised if x >= 0.05 else field_tests.FLAT

    method = dataclasses.replace(SHORT, plan=plan, distance=1.2)
    last = []
    field_tests.repeat(
        method, 75.0, "rescue", 0, watch=lambda m, qpos, time: last.append((m, qpos.copy()))
    )
    model, qpos = last[-1]
    for joint, angle in (("LKN", 0.3), ("RKN", 0.3), ("HIP", 0.2)):
        assert qpos[model.joint(joint).qposadr[0]] == pytest.approx(angle, abs=0.01)
