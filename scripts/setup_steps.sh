# shellcheck shell=bash
# How scripts/setup shows a step, keeps its log, tries again what can be, and says in five lines why it ended. To be sourced.
# The caller sets: logs (folder), again (the command that a user runs again), sudo ("" or sudo).

say() { printf '[setup] %s\n' "$*"; }
warn() { printf '[setup] %s\n' "$*" >&2; }
fail() { warn "ERROR: $*"; exit 1; }
elapsed() { printf '%d min %02d s' $((SECONDS / 60)) $((SECONDS % 60)); }

shown=0 at=""
progress() {  # TEXT: on a terminal one line that is written over, in a log a line every quarter of a minute
  at=$1
  if [ -t 1 ]; then
    printf '\r\033[K[setup] %s, %s' "$1" "$(elapsed)"
  elif [ $((SECONDS - shown)) -ge 15 ]; then
    shown=$SECONDS
    say "$1, $(elapsed)"
  fi
}
progress_ends() { at=""; [ ! -t 1 ] || printf '\r\033[K'; }

next_line() {  # the next line of the input, into line; as long as none comes, the time of what progress said last goes on
  local part rest="" code
  while true; do
    code=0
    IFS= read -r -t 1 part || code=$?
    rest+=$part
    if [ $code -le 128 ]; then
      line=$rest
      return $code
    fi
    [ -z "$at" ] || progress "$at"
  done
}

timed() {  # TEXT LOG COMMAND...: a command that says nothing of how far it is, with its time; what it says is in the log alone
  local text=$1 log=$2
  shift 2
  "$@" < /dev/null 2>&1 | {
    progress "$text"
    while next_line; do
      printf '%s\n' "$line" >> "$log"
    done
    progress_ends
  }
  return "${PIPESTATUS[0]}"
}

first_error() {  # LOG: its first line that tells of an error; what CMake says stands on the next line that is not empty
  awk '
    cmake && NF { sub(/^ +/, ""); found = cmake " " $0; exit }
    /^CMake Error/ { cmake = $0; next }
    /^E: |^ERROR: |^ERROR \[|(^|[ :])(fatal )?[Ee]rror: |^[A-Za-z_.]+Error: |: command not found|undefined reference|Killed signal|No space left/ \
      { found = $0; exit }
    NF { last = $0 }
    END { print substr(found ? found : last, 1, 400) }' "$1"
}

fail_step() {  # STEP LOG [HINT]: the last lines of a set-up that ended early
  local error
  error=$(first_error "$2")
  warn "FAILED after $(elapsed): $1"
  warn "  ${error:-it said nothing}"
  [ -z "${3:-}" ] || warn "  $3"
  warn "  log: $2"
  warn "  run $again again: it goes on where it stopped"
  exit 1
}

as_root() {  # COMMAND...: as root, with the proxies of this shell, which sudo would drop
  local settings=(DEBIAN_FRONTEND=noninteractive) name
  for name in http_proxy https_proxy no_proxy; do
    [ -z "${!name:-}" ] || settings+=("$name=${!name}")
  done
  $sudo env "${settings[@]}" "$@"
}

apt_once() {  # LOG WHAT ARGUMENT...: apt-get with its progress; what it says is in the log alone
  local log=$1 what=$2 code
  shift 2
  as_root apt-get -q -o APT::Status-Fd=1 -o Acquire::Retries=3 "$@" < /dev/null 2>&1 | {
    while next_line; do
      case "$line" in
        dlstatus:* | pmstatus:*)
          IFS=: read -r kind _ percent _ <<< "$line"
          if [ "$kind" = dlstatus ]; then kind=fetched; else kind=installed; fi
          progress "$what: ${percent%%.*} % $kind" ;;
        *) printf '%s\n' "$line" >> "$log" ;;
      esac
    done
    progress_ends
  }
  code=${PIPESTATUS[0]}
  return "$code"
}

apt_step() {  # LOG WHAT ARGUMENT...: apt-get, which waits for another process's lock and is tried once more
  local log=$1 what=$2 holder tries=1 waited=0
  shift 2
  while true; do
    : > "$log"
    apt_once "$log" "$what" "$@" && return
    if grep -qE 'Could not get lock|Unable to (acquire|lock)' "$log" && [ $waited -lt "${NOETIC_LABS_LOCK_SECONDS:-600}" ]; then
      holder=$(grep -m 1 -oE 'held by process [0-9]+( \([^)]*\))?' "$log" || true)
      [ $waited -gt 0 ] || say "$what: apt is ${holder:-held by another process}; waiting up to ${NOETIC_LABS_LOCK_SECONDS:-600} s for it"
      sleep 5
      waited=$((waited + 5))
    elif [ $tries = 1 ] && grep -qE 'Failed to fetch|Connection|timed out|Hash Sum mismatch|Temporary failure' "$log"; then
      say "$what: $(first_error "$log"); trying once more"
      tries=2
    else
      return 1
    fi
  done
}

build_once() {  # LOG COUNT COMMAND...: one that runs catkin build, with packages done of COUNT (0: as many as catkin finds). Unbuffered,
  # or the lines of a small build would come at its end.
  local log=$1 count=$2
  shift 2
  : > "$log"
  PYTHONUNBUFFERED=1 "$@" < /dev/null 2>&1 | {
    finished=0
    while next_line; do
      printf '%s\n' "$line" >> "$log"
      case "$line" in
        *"Found "*" packages"*) [ "$count" != 0 ] || { count=${line#*Found }; count=${count%% *}; } ;;
        "Finished"*"<<<"*) finished=$((finished + 1)) ;;
        "Starting"*">>>"*)
          name=${line##*>>> }
          progress "building: $finished of $count packages done, now ${name%% *}" ;;
      esac
    done
    progress_ends
  }
  return "${PIPESTATUS[0]}"
}

build_step() {  # LOG COUNT COMMAND WORD...: the build; a compiler that the kernel ended for want of memory is tried again, one at a time
  local log=$1 count=$2 failed where
  shift 2
  build_once "$log" "$count" "$@" && return
  if grep -q 'Killed signal terminated program' "$log"; then
    say "building: a compiler was ended for want of memory; trying again, one at a time"
    build_once "$log" "$count" "$1" "$2" -p 1 -j 1 "${@:3}" && return
  fi
  # "Errors << PACKAGE:JOB LOG": what failed first, and its own log
  failed=$(grep -m 1 -E '^Errors +<< ' "$log" | sed -E 's/^Errors +<< +//' || true)
  where=${failed#* }
  if [ -n "$failed" ] && [ -s "$where" ]; then
    fail_step "catkin build, package ${failed%%:*}" "$where"
  fi
  fail_step "$1 $2" "$log"
}
