#!/usr/bin/env python3
"""RViz's whole window in a process whose widgets tests can ask for: rviz_window.py CONFIG WIDTHxHEIGHT.

In its status bar a label "statuses" says what the displays say of themselves, as JSON, a label "frames" how many pictures have been
drawn, and a button "save_config" writes CONFIG.saved.
"""

import json
import signal
import sys

from python_qt_binding.QtCore import QTimer
from python_qt_binding.QtWidgets import QApplication, QLabel, QPushButton
from rviz_offscreen.bindings import disable_anti_aliasing, rviz

config = sys.argv[1]
width, height = map(int, sys.argv[2].split("x"))
app = QApplication([sys.argv[0]])
disable_anti_aliasing()  # a quarter of the work for software OpenGL
frame = rviz.VisualizationFrame()
frame.setSplashPath("")
frame.initialize(config)
statuses, frames, save = QLabel(), QLabel("0"), QPushButton("save")
statuses.setObjectName("statuses")
frames.setObjectName("frames")
save.setObjectName("save_config")
save.clicked.connect(lambda: frame.saveDisplayConfig(config + ".saved"))
frame.statusBar().addWidget(save)
frame.statusBar().addWidget(frames)
frame.statusBar().addWidget(statuses)
frame.setGeometry(0, 0, width, height)
frame.show()


def look():
    group = frame.getManager().getRootDisplayGroup()
    seen = {}
    for index in range(group.numDisplays()):
        display = group.getDisplayAt(index)
        status = display.childAt(0)
        seen[display.getName()] = [
            display.getClassId(),
            status.getName() if status else "",
            {status.childAt(i).getName(): str(status.childAt(i).getValue()) for i in range(status.numChildren())} if status else {},
        ]
    statuses.setText(json.dumps(seen))
    frames.setText(str(frame.getManager().getFrameCount()))


timer = QTimer()
timer.timeout.connect(look)
timer.start(100)  # also lets Python see its signals
for number in (signal.SIGINT, signal.SIGTERM):
    signal.signal(number, lambda *_: app.exit())  # quit() asks windows first in Qt 6, and RViz whether to save
sys.exit(app.exec_())
