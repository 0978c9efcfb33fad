"""Self-collisions: which pairs of links need no check."""

from __future__ import annotations

import threading

from python_qt_binding.QtCore import Signal
from python_qt_binding.QtWidgets import QCheckBox, QDoubleSpinBox, QHBoxLayout, QProgressBar, QPushButton, QSpinBox, QTableWidgetItem

from moveit_setup_assistant import collisions
from moveit_setup_assistant.headless import set_collisions
from moveit_setup_assistant.screens.base import CHECKED, UNCHECKED, Screen, Table, form_layout, line
from moveit_setup_assistant.words import counted


class SelfCollisionsScreen(Screen):
    """Computes the matrix in a thread of its own, and lets every pair be ticked by hand."""

    title = "Self-Collisions"
    about = (
        "Pairs of links that always touch, or never can, are not worth checking while planning. Random states of the robot tell "
        "which these are. A tick means that the pair is not checked."
    )
    _advanced, _finished = Signal(int), Signal(object)

    def __init__(self, session) -> None:
        super().__init__(session)
        self._reasons: dict[collisions.Pair, str] = {}
        self._thread: threading.Thread | None = None
        self._stop = False
        self._trials, self._always = QSpinBox(), QDoubleSpinBox()
        self._trials.setRange(1000, 100000)
        self._trials.setSingleStep(1000)
        self._trials.setValue(10000)
        self._always.setRange(1, 100)
        self._always.setValue(95)
        self._always.setSuffix(" %")
        self._button, self._progress = QPushButton("&Generate Collision Matrix"), QProgressBar()
        for widget, name in ((self._trials, "trials"), (self._always, "always"), (self._button, "generate"), (self._progress, "progress")):
            widget.setObjectName(f"collisions_{name}")
        self._button.clicked.connect(self._generate)
        form = form_layout()
        form.addRow("Sampling density", self._trials)
        form.addRow('Min. collisions for "always"-colliding pairs', self._always)
        self.layout_.addLayout(form)
        row = QHBoxLayout()
        row.addWidget(self._button)
        row.addWidget(self._progress, 1)
        row.addStretch()
        self.layout_.addLayout(row)
        self.layout_.addLayout(self._choice_of_rows())
        self._table = Table("collisions_table", ("Link A", "Link B", "Disabled", "Reason"))
        self._table.setSelectionMode(Table.ExtendedSelection)
        self._table.itemChanged.connect(self._ticked)
        self._table.itemSelectionChanged.connect(self._look)
        self.layout_.addWidget(self._table)
        self._advanced.connect(self._progress.setValue)
        self._finished.connect(self._take)
        self._show_running(False)

    def _choice_of_rows(self) -> QHBoxLayout:
        row = QHBoxLayout()
        self._filter, self._all = line(), QCheckBox("&Show enabled pairs")
        self._filter.setObjectName("collisions_filter")
        self._filter.setPlaceholderText("Part of a link's name")
        self._filter.setClearButtonEnabled(True)
        self._all.setObjectName("collisions_show_enabled")
        self._filter.textChanged.connect(self._fill)
        self._all.toggled.connect(self._fill)
        row.addWidget(self._filter)
        row.addWidget(self._all)
        return row

    def _show_running(self, runs: bool) -> None:
        """While pairs are looked for there is a bar, and nothing else can be set."""
        self._button.setText("&Stop" if runs else "&Generate Collision Matrix")
        self._progress.setVisible(runs)
        self._progress.setValue(0)
        for widget in (self._trials, self._always, self._filter, self._all, self._table):
            widget.setEnabled(not runs)

    def enter(self) -> None:
        self._reasons = {collisions.pair(p.link1, p.link2): p.reason or collisions.USER for p in self.config.semantics.disable_collisionss}
        self._fill()

    def leave(self):
        self._stop = True
        if self._thread is not None:
            self._thread.join()
            self._thread = None
        return None

    def _generate(self) -> None:
        if self._thread is not None:  # the button says Stop now
            self._stop = True
            return
        self._stop, model = False, self.config.robot.model
        trials, fraction = self._trials.value(), self._always.value() / 100

        def progress(done: float) -> bool:
            self._advanced.emit(round(100 * done))
            return not self._stop

        def run() -> None:
            self._finished.emit(collisions.compute_disabled(model, trials, fraction, progress=progress))

        self._show_running(True)
        self._thread = threading.Thread(target=run, daemon=True)
        self._thread.start()

    def _take(self, reasons) -> None:
        if self._thread is not None:
            self._thread.join()
        self._thread = None
        self._show_running(False)
        if reasons:
            self._reasons = reasons
            set_collisions(self.config, reasons)
            self._fill()
            self.session.say(f"{counted(len(reasons), 'pair')} {'needs' if len(reasons) == 1 else 'need'} no check")
        else:
            self.session.say("Stopped; the pairs are as they were.")

    def _fill(self, *_) -> None:
        rows = [
            row
            for row in collisions.collision_table(self.config.robot.model, self._reasons)
            if (row[2] or self._all.isChecked()) and any(self._filter.text() in name for name in row[:2])
        ]
        self._table.blockSignals(True)
        self._table.setRowCount(len(rows))
        for index, (one, other, reason) in enumerate(rows):
            tick = QTableWidgetItem()
            tick.setCheckState(CHECKED if reason else UNCHECKED)
            for column, item in enumerate((QTableWidgetItem(one), QTableWidgetItem(other), tick, QTableWidgetItem(reason))):
                self._table.setItem(index, column, item)
        self._table.blockSignals(False)
        self._table.spread()

    def _ticked(self, item) -> None:
        if item.column() != 2:
            return
        pair = self._pair(item.row())
        if item.checkState() == CHECKED:
            self._reasons[pair] = collisions.USER
        else:
            self._reasons.pop(pair, None)
        set_collisions(self.config, self._reasons)
        self._table.blockSignals(True)
        self._table.item(item.row(), 3).setText(self._reasons.get(pair, ""))
        self._table.blockSignals(False)

    def _pair(self, row: int) -> collisions.Pair:
        return collisions.pair(self._table.item(row, 0).text(), self._table.item(row, 1).text())

    def _look(self) -> None:
        rows = {item.row() for item in self._table.selectedItems()}
        self.session.highlight([name for row in rows for name in self._pair(row)])
