# roscd, rosls, rosed and the completions of roslaunch and the rest: Debian ships them, but no shell loads them.
if [ -f /usr/share/bash-completion/completions/rosbash ]; then
  . /usr/share/bash-completion/completions/rosbash
fi
