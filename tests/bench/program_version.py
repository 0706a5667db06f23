"""What a page of figures says it was made with."""
import os
import subprocess


def version(capfit):
    """capfit's own, and the commit where the program was built from it here and now."""
    def git(*words):
        return subprocess.run(["git", *words], capture_output=True, text=True).stdout.strip()

    text = "capfit " + subprocess.check_output([capfit, "--version"], text=True).strip()
    commit = git("rev-parse", "--short", "HEAD")
    if not commit or "CAPFIT_BUILD" in os.environ:
        return text
    changed = git("status", "--porcelain", "--", "core", "client", "CMakeLists.txt")
    return f"{text} at commit {commit}" + (" with local changes" if changed else "")
