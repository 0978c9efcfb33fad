"""Matplotlib 3.2 to 3.10."""
import functools

from noetic_names import add, aliases, renamed, without


def _matplotlib(module):
    module.use = without(module.use, "warn")


def _canvas(module):
    """``fig.canvas.set_window_title(...)``"""
    def set_window_title(self, title):
        if getattr(self, "manager", None) is not None:
            self.manager.set_window_title(title)

    def get_window_title(self):
        return self.manager.get_window_title() if getattr(self, "manager", None) is not None else None
    add(module.FigureCanvasBase, set_window_title=set_window_title, get_window_title=get_window_title)


def _agg(module):
    """Bytes of a figure, for a picture of a topic."""
    if "tostring_rgb" not in vars(module.FigureCanvasAgg):
        def tostring_rgb(self):
            import numpy
            return numpy.asarray(self.buffer_rgba())[..., :3].tobytes()
        module.FigureCanvasAgg.tostring_rgb = tostring_rgb


def _cbook(module):
    import numpy

    def is_numlike(obj):
        import numbers
        return isinstance(obj, (numbers.Number, numpy.number))
    add(module, iterable=numpy.iterable, is_numlike=is_numlike)


def _cm(module):
    def get_cmap(name=None, lut=None):
        import matplotlib.pyplot
        return matplotlib.pyplot.get_cmap(name, lut)

    def register_cmap(name=None, cmap=None, **_options):
        import matplotlib
        matplotlib.colormaps.register(cmap, name=name)
    add(module, get_cmap=get_cmap, register_cmap=register_cmap)
    maps = getattr(module, "_colormaps", None) or getattr(module, "_cmap_registry", None)
    if maps is not None:
        add(module, cmap_d=maps)


def _colors(module):
    aliases(module, DivergingNorm="TwoSlopeNorm")


def _figure(module):
    new_gca = module.Figure.gca

    @functools.wraps(new_gca)  # pyplot asks the function of which class it is
    def gca(self, **kwargs):
        """The current axes; with arguments (``projection="3d"``) those of that kind, made if the current ones are others."""
        if not kwargs:
            return new_gca(self)
        axes = self.axes and new_gca(self)
        same = axes and all(getattr(axes, {"projection": "name"}.get(key, key), None) == value for key, value in kwargs.items())
        return axes if same else self.add_subplot(1, 1, 1, **kwargs)
    module.Figure.gca = gca
    module.Figure.savefig = without(module.Figure.savefig, "frameon", "papertype")


def _axes(module):
    Axes = module.Axes
    Axes.grid = renamed(Axes.grid, b="visible")
    Axes.annotate = renamed(Axes.annotate, s="text")
    Axes.stem = without(Axes.stem, "use_line_collection")
    Axes.text = without(Axes.text, "withdash")
    for name in ("is_first_col", "is_first_row", "is_last_col", "is_last_row", "get_geometry"):
        def ask(self, _name=name):
            place = self.get_subplotspec()
            return getattr(place, _name)() if _name != "get_geometry" else (*place.get_geometry()[:2], place.num1 + 1)
        add(Axes, **{name: ask})

    def change_geometry(self, numrows, numcols, num):
        from matplotlib.gridspec import GridSpec
        self.set_subplotspec(GridSpec(numrows, numcols, figure=self.figure)[num - 1])
    add(Axes, change_geometry=change_geometry, hold=lambda self, b=None: None)


def _axis(module):
    def of_part(name):
        return property(lambda self: getattr(self, name).get_visible(), lambda self, value: getattr(self, name).set_visible(value))
    add(module.Tick, label=property(lambda self: self.label1), label1On=of_part("label1"), label2On=of_part("label2"),
        tick1On=of_part("tick1line"), tick2On=of_part("tick2line"), gridOn=of_part("gridline"))


def _lines(module):
    """A point is a line of one number."""
    for name in ("set_xdata", "set_ydata"):
        def put(self, values, _new=getattr(module.Line2D, name)):
            return _new(self, values if hasattr(values, "__iter__") else [values])
        setattr(module.Line2D, name, functools.wraps(getattr(module.Line2D, name))(put))


def _patches(module):
    """Arrows in space as courses draw them project themselves when they are drawn: ``proj_transform(x, y, z, renderer.M)``."""
    add(module.Patch, do_3d_projection=lambda self, renderer=None: 0.0)


def _axes3d(module):
    Axes3D = module.Axes3D
    new_init, new_draw = Axes3D.__init__, Axes3D.draw

    @functools.wraps(new_init)
    def __init__(self, fig, *arguments, **options):
        options.pop("auto_add_to_figure", None)
        new_init(self, fig, *arguments, **options)
        if type(self) is Axes3D and self not in fig.axes and not hasattr(fig, "get_subplotspec"):
            fig.add_axes(self)

    @functools.wraps(new_draw)
    def draw(self, renderer):
        try:
            renderer.M = self.get_proj()
        except AttributeError:  # a renderer in C takes no names
            pass
        return new_draw(self, renderer)
    Axes3D.__init__, Axes3D.draw = __init__, draw
    for letter in "xyz":
        add(Axes3D, **{f"w_{letter}axis": property(lambda self, _name=f"{letter}axis": getattr(self, _name))})


def _pyplot(module):
    module.gca = lambda **kwargs: module.gcf().gca(**kwargs)
    add(module, register_cmap=lambda name=None, cmap=None, **_options: module.colormaps.register(cmap, name=name), hold=lambda b=None: None,
        ishold=lambda: True)
    module.grid = renamed(module.grid, b="visible")
    module.annotate = renamed(module.annotate, s="text")
    module.stem = without(module.stem, "use_line_collection")


def _style(module):
    """``seaborn-whitegrid`` is called ``seaborn-v0_8-whitegrid`` now."""
    for name in [name for name in module.library if name.startswith("seaborn-v0_8")]:
        module.library.setdefault("seaborn" + name[len("seaborn-v0_8"):], module.library[name])
    new_use = module.use

    @functools.wraps(new_use)
    def use(style):
        if isinstance(style, str) and style.startswith("seaborn") and style in module.library:
            style = module.library[style]
        return new_use(style)
    module.use = use


COMPLETE = {"matplotlib": _matplotlib, "matplotlib.axes": _axes, "matplotlib.axis": _axis, "matplotlib.backend_bases": _canvas,
            "matplotlib.backends.backend_agg": _agg, "matplotlib.cbook": _cbook, "matplotlib.cm": _cm, "matplotlib.colors": _colors,
            "matplotlib.figure": _figure, "matplotlib.lines": _lines, "matplotlib.patches": _patches, "matplotlib.pyplot": _pyplot,
            "matplotlib.style": _style, "mpl_toolkits.mplot3d.axes3d": _axes3d}
