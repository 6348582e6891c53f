"""The files of models/: each loads alone and steps, meshes are what their script writes."""

import re
import subprocess
import sys

import mujoco
import numpy as np
import pytest

from robot_models import FRAGMENTS, MODELS, MODULES, ROBOTS, load


@pytest.mark.parametrize(
    "file", ["robots/rescue", "robots/manipulation", "scenes/stretch", "objects/casualty_75kg"]
)
def test_a_complete_file_loads_alone_and_steps(file):
    model = load(f"{file}.xml")
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 10)
    assert np.isfinite(data.qpos).all() and not any(w.number for w in data.warning)


@pytest.mark.parametrize("path", FRAGMENTS, ids=lambda p: p.stem)
def test_a_module_loads_alone_on_a_stand_and_steps(path):
    model = mujoco.MjModel.from_xml_string(f"""<mujoco><include file="{MODELS}/common/options.xml"/>
        <include file="{MODELS}/common/classes.xml"/><include file="{MODELS}/common/looks.xml"/>
        <worldbody><body name="stand"><include file="{path}"/></body></worldbody></mujoco>""")
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 10)
    assert model.ngeom > 1 and np.isfinite(data.qpos).all()


def test_every_module_is_part_of_a_robot():
    used = {
        f
        for r in ROBOTS
        for f in re.findall(r"modules/(\w+)", (MODELS / f"robots/{r}.xml").read_text())
    }
    assert used | {"transfer_bed_rims"} == {path.stem for path in MODULES}  # of `add_rims`


def test_a_model_loads_from_a_relative_path_too(monkeypatch):
    monkeypatch.chdir(MODELS.parent)
    assert mujoco.MjModel.from_xml_path("models/scenes/stretch.xml").nkey == 6


def test_the_meshes_are_what_their_script_writes(tmp_path):
    script = MODELS / "assets/make_meshes.py"
    subprocess.run([sys.executable, "-B", script, tmp_path], check=True, capture_output=True)
    kept = {f.name: f.read_text() for f in (MODELS / "assets/meshes").iterdir()}
    assert {f.name: f.read_text() for f in tmp_path.iterdir()} == kept
