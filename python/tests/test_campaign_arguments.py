"""The arguments of `python -m mechaudit.campaign`: refused at once, whatever cluster there is."""

import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest
from mechaudit import campaign

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("option", ["--local", "--batch", "--shards"])
@pytest.mark.parametrize("bad", ["0", "-1", "1.5", "x", "", "1000000000000"])
def test_counts_are_positive(option, bad, capsys):
    arguments = {"--local": "1", "--batch": "1", "--shards": "1", option: bad}
    words = [word for pair in arguments.items() for word in pair]
    with pytest.raises(SystemExit) as ended:
        campaign.main(["plan.toml", *words])
    assert ended.value.code == 2
    said = capsys.readouterr().err
    assert f"argument {option}: must be a whole number from 1 to" in said and repr(bad) in said


def test_a_batch_is_checked_in_python_too(tmp_path):
    pytest.importorskip("distributed")
    pytest.importorskip("tqdm")
    for bad in (0, -1, 10**9):
        with pytest.raises(ValueError, match="batch must be between 1 and"):
            campaign.run(tmp_path, None, batch=bad)
    for bad in ("1", 1.0, True):
        with pytest.raises(TypeError, match="batch"):
            campaign.run(tmp_path, None, batch=bad)
    for bad in (0, 10**9):
        with pytest.raises(ValueError, match="shards"):
            campaign.plan(tmp_path, tmp_path, shards=bad)


@pytest.mark.parametrize("missing", ["tqdm", "distributed"])
def test_what_is_not_installed_is_named(missing, tmp_path):
    code = f"""
import sys
sys.modules[{missing!r}] = None
from mechaudit import campaign
sys.exit(campaign.main([sys.argv[1], "--local", "1", "--binary", "/bin/true"]))
"""
    done = subprocess.run([sys.executable, "-c", code, str(tmp_path)], capture_output=True, text=True, timeout=120)
    assert done.returncode == 2, done.stderr
    assert f"needs {missing}: pip install 'mechaudit[campaign]'" in done.stderr and "Traceback" not in done.stderr


def test_commands_in_the_pages_are_commands():
    found = 0
    for page in ("python/README.md", "src/book/campaigns.md"):
        text = (ROOT / page).read_text()
        for command in re.findall(r"python -m mechaudit\.campaign ([^`\n]+)", text):
            campaign._parser().parse_args(shlex.split(command))
            found += 1
    assert found >= 3
