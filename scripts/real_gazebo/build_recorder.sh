#!/bin/sh
# Within the chroot: FOLDER of recorder.cc, FOLDER for librecorder.so.
set -e
# shellcheck disable=SC2046
g++ -std=c++17 -O1 -fPIC -shared -o "$2/librecorder.so" "$1/recorder.cc" $(pkg-config --cflags --libs gazebo) -std=c++17
