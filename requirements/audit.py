"""Compare lists of packages with the known vulnerabilities: `audit.py PIP-AUDIT LIST...`, run by `make audit`.

Exit code 0: all were compared and nothing is known against them. 1: vulnerabilities, listed. 2: not all could be
compared, in one sentence: no news is no good news.
"""

from __future__ import annotations

import json
import subprocess
import sys
from typing import Any

OPTIONS = ("--require-hashes", "--disable-pip", "--format", "json", "--progress-spinner", "off")


def main(tool: str, lists: list[str]) -> int:
    """Audit each list; return the exit code."""
    worst = 0
    for name in lists:
        code, text = judged(name, tool)
        (sys.stdout if code == 0 else sys.stderr).write(text + "\n")
        worst = max(worst, code)
    return worst


def judged(name: str, tool: str) -> tuple[int, str]:
    """Return the exit code for a list, and what to say of it."""
    command = [tool, *OPTIONS, "--requirement", name]
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except OSError as error:
        return 2, f"audit: {name} was not compared: {tool} cannot be run ({error.strerror})"
    try:
        packages: list[dict[str, Any]] = json.loads(done.stdout)["dependencies"]
    except (ValueError, KeyError):
        last = next((line for line in reversed(done.stderr.splitlines()) if line.strip()), "nothing was said")
        return (
            2,
            f"audit: {name} was not compared: no database of vulnerabilities could be reached ({last.strip()[:200]})",
        )
    skipped = [package["name"] for package in packages if "skip_reason" in package]
    if skipped and len(skipped) == len(packages):
        return 2, f"audit: {name} was not compared: no database of vulnerabilities answers from this machine"
    known = [(p["name"], p["version"], v["id"]) for p in packages for v in p.get("vulns", [])]
    if known:
        return 1, "\n".join(f"audit: {name}: {package} {version}: {what}" for package, version, what in known)
    if skipped or not packages:
        return 2, f"audit: {name} was not compared as a whole: not found were {', '.join(skipped) or 'any packages'}"
    return 0, f"audit: {name}: nothing is known against its {len(packages)} packages"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
