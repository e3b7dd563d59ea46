# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
# Steps with a name, a time and a verdict, for scripts whose output is read by people and by CI.
# Source it after `set -uo pipefail`; a step that fails does not end the script, its verdict is kept.

step_names=()
step_minutes=()
step_verdicts=()
steps_failed=0
# Seconds since 1970 until which steps may run; empty: for ever. A step that is running then is ended and has failed,
# one that was not begun yet is not begun: whoever gives a run so many minutes still gets its verdicts.
steps_deadline=

minutes_since() { # START: minutes with one digit
  awk -v start="$1" -v now="$(date +%s.%N)" 'BEGIN { printf "%.1f", (now - start) / 60 }'
}

# in_time COMMAND...: runs it until the deadline, then ends it with everything that it started: status 124.
in_time() {
  if [ -z "$steps_deadline" ]; then
    "$@" </dev/null
    return
  fi
  local job alarm first=
  set -m # a process group of its own
  "$@" </dev/null &
  job=$!
  sleep $((steps_deadline - $(date +%s))) &
  alarm=$!
  set +m
  trap 'kill -TERM -- "-$job" "-$alarm" 2>/dev/null; exit 130' INT TERM
  wait -n -p first "$job" "$alarm"
  local status=$?
  trap - INT TERM
  if [ "$first" = "$alarm" ]; then
    kill -TERM -- "-$job"
    sleep 2 # to say goodbye in
    kill -KILL -- "-$job" 2>/dev/null
    return 124
  fi
  kill -TERM -- "-$alarm"
  return $status
}

# step NAME COMMAND...: runs it, shows its output, keeps its time and verdict, returns its status.
step() {
  local name=$1 start status=0 verdict=ok minutes
  shift
  if [ -n "$steps_deadline" ] && [ "$(date +%s)" -ge "$steps_deadline" ]; then
    skip_step "$name" "the time is up"
    return 124
  fi
  printf '\n== %s\n   %s\n' "$name" "$*"
  start=$(date +%s.%N)
  in_time "$@" || status=$?
  minutes=$(minutes_since "$start")
  if [ $status = 124 ] && [ -n "$steps_deadline" ] && [ "$(date +%s)" -ge "$steps_deadline" ]; then
    verdict="OUT OF TIME"
    steps_failed=$((steps_failed + 1))
  elif [ $status != 0 ]; then
    verdict="FAILED ($status)"
    steps_failed=$((steps_failed + 1))
  fi
  printf '== %s: %s, %s min\n' "$name" "$verdict" "$minutes"
  step_names+=("$name")
  step_minutes+=("$minutes")
  step_verdicts+=("$verdict")
  return $status
}

# meanwhile FOLDER COMMAND...: runs it in the background until it ends or the script does, on what the steps leave of the
# processors; its log is FOLDER/log. Of what it builds, steps run the same command again: build() waits for what builds in its
# folder. What the command runs as a part(), became_of_part() tells of.
meanwhile() {
  meanwhile_folder=$1
  shift
  rm -rf "$meanwhile_folder"
  mkdir -p "$meanwhile_folder"
  # A session of its own: the kernel weighs sessions first (sched(7), autogroups), then the threads of each.
  setsid bash -c 'echo 19 >/proc/self/autogroup; chrt --idle --pid 0 $$ && exec "$@"' meanwhile "$@" </dev/null \
    >"$meanwhile_folder/log" 2>&1 &
  meanwhile_job=$!
  trap 'kill -TERM -- "-$meanwhile_job" 2>/dev/null' EXIT
}

# part FOLDER NAME COMMAND...: in what runs meanwhile, with the same folder; keeps what is printed and the status.
part() {
  local place=$1/$2 status=0
  shift 2
  "$@" >"$place.log" 2>&1 || status=$?
  echo $status >"$place.new" && mv "$place.new" "$place.status"
}

# became_of_part NAME: waits for it, shows the end of its log, more of it when it failed, and returns its status.
became_of_part() {
  local place=$meanwhile_folder/$1 status=1 lines=3000
  until [ -e "$place.status" ] || ! kill -0 "$meanwhile_job" 2>/dev/null; do sleep 0.2; done
  [ ! -e "$place.status" ] || status=$(cat "$place.status")
  [ "$status" != 0 ] || lines=100
  if [ -e "$place.log" ]; then tail -n $lines "$place.log"; else tail -n $lines "$meanwhile_folder/log"; fi
  return "$status"
}

# skip_step NAME WHY: a step that cannot run because one before it failed, or for want of time. It failed too.
skip_step() {
  printf '\n== %s: not run, %s\n' "$1" "$2"
  step_names+=("$1")
  step_minutes+=("0.0")
  step_verdicts+=("NOT RUN")
  steps_failed=$((steps_failed + 1))
}

# summary TITLE: one line a step and the whole time. Returns 1 when a step failed.
summary() {
  local i
  printf '\n%s\n' "$1"
  for i in "${!step_names[@]}"; do
    printf '  %-40s %6s min  %s\n' "${step_names[$i]}" "${step_minutes[$i]}" "${step_verdicts[$i]}"
  done
  printf '  %-40s %6s min  ' "all" "$(minutes_since "$steps_start")"
  if [ $steps_failed = 0 ]; then
    echo ok
  else
    echo "FAILED: $steps_failed step(s)"
    return 1
  fi
}

# say_skipped PRESET: the tests that ran nothing, or that this machine could not judge, by name.
say_skipped() {
  sed -n "s/^ *[0-9]*\/[0-9]* Test *#[0-9]*: \([^ ]*\) .*\*\*\*Skipped.*/skipped ($1): \1/p" "build/$1"/*.log 2>/dev/null
}

# build PRESET [TARGET...]: configures and builds. The whole log goes to build/PRESET.log; what is shown is its
# end, or on failure every error in it.
build() {
  local preset=$1 log=build/$1.log
  shift
  mkdir -p build || return 1
  # One at a time in a folder: two ninjas in it undo each other's work.
  local lock
  exec {lock}>"build/$preset.lock" || return 1
  flock -n "$lock" || { echo "   waiting for another build in build/$preset"; flock "$lock"; }
  build_alone "$preset" "$log" "$@"
  local status=$?
  exec {lock}>&-
  return $status
}

build_alone() { # PRESET LOG [TARGET...]
  local preset=$1 log=$2
  shift 2
  # Where the tree stands is no part of a compilation: a fresh clone finds what another one compiled.
  if ! { cmake --preset "$preset" &&
    CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1 cmake --build "build/$preset" --parallel "$jobs" ${1:+--target "$@"}; } \
    >"$log" 2>&1; then
    grep -nE 'error|warning|FAILED|Error' "$log" | head -n 60
    echo "   ... the end of $log:"
    tail -n 40 "$log"
    return 1
  fi
  tail -n 1 "$log"
}

# As many jobs as there are processors, but not more than memory carries: a file with Eigen under a sanitizer
# takes up to 1.5 GB.
default_jobs() {
  local processors memory_gb
  processors=$(nproc)
  memory_gb=$(awk '/^MemAvailable/ { print int($2 / 1048576) }' /proc/meminfo)
  local by_memory=$(((memory_gb * 2) / 3))
  [ $by_memory -ge 1 ] || by_memory=1
  echo $((processors < by_memory ? processors : by_memory))
}

steps_start=$(date +%s.%N)
