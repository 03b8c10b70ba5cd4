#!/usr/bin/env bash
# run.sh BUILD_FOLDER SECONDS NAME: runs the fuzz target NAME for so long. What it found is left in BUILD_FOLDER/findings,
# the inputs that it keeps in BUILD_FOLDER/corpus/NAME, from where the next run goes on. Prints one line.
set -euo pipefail
build=$1 seconds=$2 name=$3
seeds=$(dirname "${BASH_SOURCE[0]}")/seeds/$name
corpus=$build/corpus/$name log=$build/$name.log
mkdir -p "$corpus" "$build/findings"
[[ -d $seeds ]] || { echo "$name: no seeds in $seeds" >&2; exit 1; }

# A reader must not need more memory or time for a small input than these.
longest=4096
[[ $name =~ ^(zygo_dat|hdf5|fits)$ ]] && longest=16384  # their headers alone take half of it
limits=(-max_len=$longest -malloc_limit_mb=64 -rss_limit_mb=1024 -timeout=5)
status=0
"$build/tests/fuzz/fuzz_$name" "${limits[@]}" -max_total_time="$seconds" -print_final_stats=1 \
  -artifact_prefix="$build/findings/$name-" "$corpus" "$seeds" >"$log" 2>&1 || status=$?
if [[ $status -ne 0 ]]; then
  echo "fuzz $name: FOUND, exit code $status" >&2
  tail -n 60 "$log" >&2
  exit 1
fi
stat() { sed -n "s/^stat::$1: *//p" "$log"; }
printf 'fuzz %-12s %9d runs, %7d a second, %5d inputs in the corpus\n' "$name" "$(stat number_of_executed_units)" \
  "$(stat average_exec_per_sec)" "$(find "$corpus" -type f | wc -l)"
