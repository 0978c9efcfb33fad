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
  local -a plain
  plain=(${${words[3,CURRENT-1]:#-*}:#*:=*})
  if (( CURRENT == 2 )); then
    compadd launch
  elif [[ "${words[CURRENT]}" == -* ]]; then
    compadd -- $(mon launch --help | grep -o -e '--[a-z-]*=\?' | sort -u)
  elif (( ${#plain} == 0 )); then
    compadd -- $(rospack list-names)
    _files -g '*.launch'
  elif (( ${#plain} == 1 )) && [[ ! -f "${plain[1]}" ]]; then
    compadd -- $(find -L "$(rospack find ${plain[1]} 2>/dev/null)" -name '*.launch' -printf '%f\n' 2>/dev/null)
  else
    compadd -S ':=' -- $(mon launch --list-args ${plain} 2>/dev/null)
  fi
}
(( ${+functions[compdef]} )) && compdef _mon_complete mon
