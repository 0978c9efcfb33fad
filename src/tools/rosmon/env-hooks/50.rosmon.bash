# The command 'mon launch', and completion of packages, launch files and arguments.

mon() {
  if [ "$1" != launch ]; then
    echo "mon: expected 'mon launch [options] PACKAGE FILE.launch [arg:=value ...]'; see 'mon launch --help'" >&2
    return 1
  fi
  shift
  rosrun rosmon_core rosmon "$@"
}

_mon_complete() {
  local word="${COMP_WORDS[COMP_CWORD]}" line="${COMP_LINE:0:COMP_POINT}" IFS=$' \t\n'
  local -a words
  read -r -a words <<< "$line"
  [[ "$line" == *" " ]] && words+=("")
  COMPREPLY=()
  if [ "${#words[@]}" -eq 2 ]; then
    COMPREPLY=($(compgen -W "launch" -- "$word"))
    return
  fi
  # the words that are neither options nor arguments, without the one being typed
  local -a plain=()
  local w
  for w in "${words[@]:2:${#words[@]}-3}"; do
    case "$w" in -*|*:=*) ;; *) plain+=("$w") ;; esac
  done
  local last="${words[${#words[@]}-1]}"
  if [[ "$last" == -* ]]; then
    COMPREPLY=($(compgen -W "$(mon launch --help | grep -o -e '--[a-z-]*=\?' | sort -u)" -- "$word"))
    [[ "${COMPREPLY[0]}" == *= ]] && compopt -o nospace
  elif [ "${#plain[@]}" -eq 0 ]; then
    COMPREPLY=($(compgen -W "$(rospack list-names)" -- "$word") $(compgen -f -X '!*.launch' -- "$word"))
  elif [ "${#plain[@]}" -eq 1 ] && [ ! -f "${plain[0]}" ]; then
    COMPREPLY=($(compgen -W "$(find -L "$(rospack find "${plain[0]}" 2>/dev/null)" -name '*.launch' -printf '%f\n' \
      2>/dev/null)" -- "$word"))
  else
    COMPREPLY=($(compgen -S ":=" -W "$(mon launch --list-args "${plain[@]}" 2>/dev/null)" -- "$word"))
    compopt -o nospace
  fi
}
complete -F _mon_complete mon
