"""What a robot out of a URDF looks like: visuals, meshes that MuJoCo does not read, colours."""

from __future__ import annotations

import sys
from pathlib import Path

import mujoco
import numpy as np
import pytest
import trimesh

import hurcules

LINK = """<robot name="one"><link name="base">
  <inertial>
    <mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/>
  </inertial>
  {shapes}
</link></robot>"""
MESH = '<geometry><mesh filename="{}" scale="{}"/></geometry>'
RED, BLUE = (255, 0, 0, 255), (0, 0, 255, 255)


def box(place: float, colour: tuple[int, ...]) -> trimesh.Trimesh:
    """A box of 2 cm, in centimetres, `place` along x."""
    mesh = trimesh.creation.box(extents=(2, 2, 2))
    mesh.apply_translation((place, 0, 0))
    mesh.visual.face_colors = colour
    return mesh


@pytest.fixture
def collada(tmp_path: Path) -> Path:
    """Two red boxes and a blue one, in a file whose unit is the centimetre."""
    text = trimesh.exchange.dae.export_collada([box(0, RED), box(10, RED), box(20, BLUE)])
    text = text.decode() if isinstance(text, bytes) else text
    unit = '<unit meter="0.01" name="centimeter"/>'
    assert "<asset>" in text
    text = text.replace("<asset>", f"<asset>{unit}")
    path = tmp_path / "part.dae"
    path.write_text(text)
    return path


def test_a_mesh_of_many_colours_is_a_geom_for_each(collada: Path) -> None:
    shapes = f"<visual>{MESH.format(collada, '1 1 1')}</visual>"
    model = hurcules.load_urdf(LINK.format(shapes=shapes))
    assert model.ngeom == 2
    assert (model.geom_group == 1).all()
    assert not (model.geom_contype | model.geom_conaffinity).any()
    red, blue = sorted(range(2), key=lambda i: -model.geom_rgba[i, 0])
    np.testing.assert_allclose(model.geom_rgba[red], [1, 0, 0, 1])
    np.testing.assert_allclose(model.geom_rgba[blue], [0, 0, 1, 1])
    # in metres: red about 5 cm, blue about 20 cm along x, 2 cm thick
    np.testing.assert_allclose(model.geom_pos[red], [0.05, 0, 0], atol=1e-6)
    np.testing.assert_allclose(model.geom_pos[blue], [0.20, 0, 0], atol=1e-6)
    assert model.body_mass[1] == 1.0


def test_what_touches_is_one_mesh_and_hidden_where_there_is_more_to_see(collada: Path) -> None:
    seen = f"<visual>{MESH.format(collada, '1 1 1')}</visual>"
    touched = f"<collision>{MESH.format(collada, '2 2 2')}</collision>"
    model = hurcules.load_urdf(LINK.format(shapes=seen + touched))
    np.testing.assert_array_equal(np.sort(model.geom_group), [1, 1, 3])
    hull = int(np.argmax(model.geom_group))
    assert model.geom_contype[hull] == 1
    corners = model.mesh_vert[model.mesh_vertadr[model.geom_dataid[hull]] :]
    assert np.ptp(corners, axis=0).max() == pytest.approx(2 * 0.22, rel=1e-5)  # scaled
    only = hurcules.load_urdf(LINK.format(shapes=seen + touched), visuals=False)
    assert (only.ngeom, int(only.geom_group[0])) == (1, 0)
    assert hurcules.load_urdf(LINK.format(shapes=seen + touched), shapes=False).ngeom == 0


def test_a_colour_of_the_file_does_not_go_on_to_the_next_shape(tmp_path: Path) -> None:
    (tmp_path / "part.stl").write_bytes(box(0, RED).export(file_type="stl"))
    material = '<material name="m"><color rgba="0 1 0 1"/></material>'
    geometry = MESH.format(tmp_path / "part.stl", "1 1 1")
    shapes = f"<visual>{geometry}{material}</visual><visual>{geometry}</visual>"
    model = hurcules.load_urdf(LINK.format(shapes=shapes))
    np.testing.assert_allclose(model.geom_rgba, [[0, 1, 0, 1], [0.7, 0.7, 0.7, 1]], atol=1e-6)


def test_a_specification_with_converted_meshes_is_a_file_that_stands_alone(collada: Path) -> None:
    shapes = f"<visual>{MESH.format(collada, '1 1 1')}</visual>"
    spec = hurcules.urdf_spec(LINK.format(shapes=shapes))
    spec.compile()
    collada.unlink()
    assert mujoco.MjModel.from_xml_string(spec.to_xml()).ngeom == 2


def test_text_stl_is_read(tmp_path: Path) -> None:
    (tmp_path / "part.stl").write_text(box(0, RED).export(file_type="stl_ascii"))
    shapes = f"<collision>{MESH.format(tmp_path / 'part.stl', '0.01 0.01 0.01')}</collision>"
    model = hurcules.load_urdf(LINK.format(shapes=shapes))
    np.testing.assert_allclose(model.geom_size[0], 0.01, rtol=1e-5)


def test_without_trimesh_it_says_what_reads_them(
    collada: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shapes = f"<visual>{MESH.format(collada, '1 1 1')}</visual>"
    monkeypatch.setitem(sys.modules, "trimesh", None)
    with pytest.warns(UserWarning, match=r"1 shapes are left out.*hurcules\[urdf\]") as told:
        assert hurcules.load_urdf(LINK.format(shapes=shapes)).ngeom == 0
    assert [warning.filename for warning in told] == [__file__]


def test_a_mesh_that_nothing_reads_is_told(tmp_path: Path) -> None:
    (tmp_path / "part.dae").write_text("no mesh")
    shapes = f"<visual>{MESH.format(tmp_path / 'part.dae', '1 1 1')}</visual>"
    with pytest.warns(UserWarning, match=r"1 shapes are left out.*part\.dae: trimesh: \w"):
        hurcules.load_urdf(LINK.format(shapes=shapes))


def test_files_of_one_name_in_two_folders_are_two_meshes(tmp_path: Path) -> None:
    for folder, size in (("seen", 0.1), ("touched", 0.3)):
        (tmp_path / folder).mkdir()
        mesh = trimesh.creation.box(extents=(size, size, size))
        (tmp_path / folder / "part.stl").write_bytes(mesh.export(file_type="stl"))
    seen = f"<visual>{MESH.format(tmp_path / 'seen/part.stl', '1 1 1')}</visual>"
    touched = f"<collision>{MESH.format(tmp_path / 'touched/part.stl', '1 1 1')}</collision>"
    scaled = f"<collision>{MESH.format(tmp_path / 'touched/part.stl', '2 2 2')}</collision>"
    model = hurcules.load_urdf(LINK.format(shapes=seen + touched + scaled))
    np.testing.assert_allclose(np.sort(model.geom_size[:, 0]), [0.05, 0.15, 0.3], rtol=1e-5)
    assert model.geom_group[np.argmin(model.geom_size[:, 0])] == 1


def test_a_large_stl_and_a_coloured_ply_are_read(tmp_path: Path) -> None:
    large = trimesh.creation.icosphere(subdivisions=7, radius=0.1)
    assert len(large.faces) > 200_000  # that MuJoCo takes of STL
    (tmp_path / "large.stl").write_bytes(large.export(file_type="stl"))
    (tmp_path / "red.ply").write_bytes(box(0, RED).export(file_type="ply"))
    shapes = [MESH.format(tmp_path / name, "1 1 1") for name in ("large.stl", "red.ply")]
    model = hurcules.load_urdf(
        LINK.format(shapes="".join(f"<visual>{shape}</visual>" for shape in shapes))
    )
    np.testing.assert_allclose(model.geom_rgba, [[0.7, 0.7, 0.7, 1], [1, 0, 0, 1]], atol=1e-6)


def test_what_is_flat_touches_nothing_and_is_told(tmp_path: Path) -> None:
    flat = trimesh.Trimesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], [[0, 1, 2], [1, 3, 2]])
    (tmp_path / "flat.ply").write_bytes(flat.export(file_type="ply"))
    geometry = MESH.format(tmp_path / "flat.ply", "1 1 1")
    assert hurcules.load_urdf(LINK.format(shapes=f"<visual>{geometry}</visual>")).ngeom == 1
    with pytest.warns(UserWarning, match="flat, and touches nothing"):
        model = hurcules.load_urdf(LINK.format(shapes=f"<collision>{geometry}</collision>"))
    assert model.ngeom == 0


def test_a_colour_that_a_mesh_overrides_is_still_that_of_others(collada: Path) -> None:
    green = '<material name="m"><color rgba="0 1 0 1"/></material>'
    overridden = f'<visual name="v">{MESH.format(collada, "1 1 1")}{green}</visual>'
    other = '<visual><geometry><sphere radius="0.1"/></geometry><material name="m"/></visual>'
    model = hurcules.load_urdf(LINK.format(shapes=overridden + other))
    sphere = int(np.flatnonzero(model.geom_type == mujoco.mjtGeom.mjGEOM_SPHERE)[0])
    np.testing.assert_allclose(model.geom_rgba[sphere], [0, 1, 0, 1])
    assert sphere == model.ngeom - 1  # in the order of the file


@pytest.mark.parametrize("name", ["package://", "package:///", "file:///none/a%20b.stl", ""])
def test_a_name_that_leads_nowhere_is_told(name: str) -> None:
    shapes = f"<visual>{MESH.format(name, '1 1 1')}</visual>"
    with pytest.warns(UserWarning, match="1 shapes are left out.*is not there"):
        hurcules.load_urdf(LINK.format(shapes=shapes))


def test_inertia_may_leave_products_out() -> None:
    text = LINK.format(shapes="").replace(' ixy="0" ixz="0" iyz="0"', "")
    np.testing.assert_allclose(hurcules.load_urdf(text).body_inertia[1], 0.1)
