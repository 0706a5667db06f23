#!/usr/bin/env bash
# Runs the tests beside this script with the installed package.
#
#   run_tests.sh TARGET SERVER CAPFIT PATTERN
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
[ -e "$1/capfit/__init__.py" ] ||
  { echo "SKIPPED: no package in $1, see the test python_client.install" >&2; exit 77; }
export PYTHONPATH=$1 PYTHONDONTWRITEBYTECODE=1
export CAPFIT_SITE=$1 CAPFIT_SERVER_PROGRAM=$2 CAPFIT_PROGRAM=$3
exec /usr/bin/python3 -m unittest discover --start-directory "$here" --pattern "$4"
