"""Comments cite pages that exist: sections of docs/design, and any other page by its name.

Strategy: every file of the repository is searched for citations and for names of pages, which are
looked up among the headings and the files. Negative controls: a missing section, a missing page.
"""

import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGES = sorted((ROOT / "docs" / "design").glob("*.md"))
FOLDERS = ("cpp", "python", "models", "envs", "docs", "tests", "benchmarks")
KINDS = {".py", ".cpp", ".hpp", ".md", ".xml", ".txt", ".cmake", ".toml"}
# docs/design/robot.md#joints, or shorter robot#joints
CITATION = re.compile(rf"\b({'|'.join(page.stem for page in PAGES)})(?:\.md)?#([a-z0-9-]+)")
# solver.md §4, solver.md, section 4
SECTION = re.compile(r"\b([\w-]+\.md),? (?:§|section )(\d+)")
PAGE = re.compile(r"(?<![\w*{.-])\w[\w.-]*\.md\b")
WRITTEN = {"claims.md", "out.md"}  # by the program


def anchor(heading: str) -> str:
    """The name that a page's heading goes by in a link."""
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")


def headings(page: Path) -> list[str]:
    return re.findall(r"^#+ +(.+)$", page.read_text(encoding="utf-8"), re.MULTILINE)


ANCHORS = {page.stem: {anchor(one) for one in headings(page)} for page in PAGES}


def tracked() -> list[Path]:
    """The files that are searched."""
    call = ["git", "-C", str(ROOT), "ls-files", "--", *FOLDERS]
    try:
        listed = subprocess.run(call, capture_output=True, text=True, check=True).stdout.split("\n")
        files = [ROOT / name for name in listed if name]
    except (OSError, subprocess.CalledProcessError):  # not a checkout
        files = [path for folder in FOLDERS for path in (ROOT / folder).rglob("*")]
    mine = Path(__file__).resolve()
    return [file for file in files if file.suffix in KINDS and file.is_file() and file != mine]


FILES = tracked()
TEXTS = {file.relative_to(ROOT).as_posix(): file.read_text(encoding="utf-8") for file in FILES}
NAMES = {file.name for file in FILES} | {file.name for file in ROOT.glob("*.md")} | WRITTEN


def unresolved(text: str) -> list[str]:
    """Citations of sections that are missing, and names of pages that are."""
    found = [f"{page}#{name}" for page, name in CITATION.findall(text) if name not in ANCHORS[page]]
    for page, number in SECTION.findall(text):
        pages = [file for file in FILES if file.name == page]
        if not any(re.match(rf"{number}\.? ", one) for file in pages for one in headings(file)):
            found.append(f"{page} §{number}")
    return found + [page for page in PAGE.findall(text) if page not in NAMES]


def test_every_citation_resolves() -> None:
    found = {name: unresolved(text) for name, text in TEXTS.items()}
    assert {name: missing for name, missing in found.items() if missing} == {}


def test_the_search_finds_citations() -> None:
    cited = [one for text in TEXTS.values() for one in CITATION.findall(text)]
    assert len(cited) > 40
    assert {page for page, _ in cited} == set(ANCHORS)


@pytest.mark.parametrize(
    "text, missing",
    [
        ("docs/design/robot.md#joints", []),
        ("[robot#wings]", ["robot#wings"]),
        ("solver.md §1, solver.md, section 99", ["solver.md §99"]),
        ("as in no-such-page.md", ["no-such-page.md"]),
    ],
)
def test_what_is_missing_is_found(text: str, missing: list[str]) -> None:
    assert unresolved(text) == missing
