"""Matplotlib 3.2 to 3.10."""

import functools

from noetic_names import add, aliases, positional, renamed, without


def _matplotlib(module):
    module.use = without(module.use, "warn")
    new_set = module.RcParams.__setitem__

    def __setitem__(self, key, val):
        if key not in _FORMER_PARAMETERS:
            new_set(self, key, val)

    module.RcParams.__setitem__ = __setitem__


#: Of rcParams, without a successor.
_FORMER_PARAMETERS = {
    "animation.avconv_args",
    "animation.avconv_path",
    "animation.html_args",
    "datapath",
    "examples.directory",
    "keymap.all_axes",
    "savefig.frameon",
    "savefig.jpeg_quality",
    "text.latex.preview",
    "text.latex.unicode",
    "verbose.fileo",
    "verbose.level",
}


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
    add(module.RendererAgg, tostring_rgb=module.FigureCanvasAgg.tostring_rgb)


def _cbook(module):
    import numpy

    def is_numlike(obj):
        import numbers

        return isinstance(obj, (numbers.Number, numpy.number))

    import matplotlib

    warning = getattr(matplotlib, "MatplotlibDeprecationWarning", DeprecationWarning)
    add(module, iterable=numpy.iterable, is_numlike=is_numlike, mplDeprecation=warning, MatplotlibDeprecationWarning=warning)
    if hasattr(module, "GrouperView"):
        add(module.GrouperView, join=lambda self, *axes: self._grouper.join(*axes))


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


def _colorbar(module):
    """Colours are the picture's: what set them at its bar did nothing in Matplotlib 3.1."""
    add(
        module.Colorbar,
        draw_all=lambda self: self._draw_all(),
        set_clim=lambda self, vmin=None, vmax=None: None,
        set_cmap=lambda self, cmap: None,
        set_norm=lambda self, norm: None,
    )


def _contour(module):
    """The lines of all levels are one thing now: who hides, removes or colours each of them does it to all."""
    if hasattr(module.ContourSet, "get_paths"):
        add(module.ContourSet, collections=property(lambda self: [self]))


def _dates(module):
    """Days since what Matplotlib counts from, from seconds since 1970."""
    add(
        module,
        epoch2num=lambda e: module.date2num(_epoch()) + _array(e) / 86400.0,
        num2epoch=lambda d: (_array(d) - module.date2num(_epoch())) * 86400.0,
    )


def _epoch():
    import datetime

    return datetime.datetime(1970, 1, 1)


def _array(values):
    import numpy

    return numpy.asarray(values)


def _scale(module):
    for scale in (module.LogScale, module.SymmetricalLogScale):
        scale.__init__ = renamed(
            scale.__init__,
            **{
                old + axis: new
                for axis in "xy"
                for old, new in (
                    ("base", "base"),
                    ("subs", "subs"),
                    ("nonpos", "nonpositive"),
                    ("linthresh", "linthresh"),
                    ("linscale", "linscale"),
                )
            },
        )


def _widgets(module):
    for cls, names, gone in (
        (
            module.RectangleSelector,
            {"rectprops": "props", "maxdist": "grab_range", "marker_props": "handle_props"},
            ("drawtype", "lineprops"),
        ),
        (module.SpanSelector, {"rectprops": "props", "span_stays": "interactive"}, ()),
        (module.LassoSelector, {"lineprops": "props"}, ()),
    ):
        if not any(old in cls.__init__.__code__.co_varnames for old in names):
            cls.__init__ = without(renamed(cls.__init__, **names), *gone)


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
    Axes.stem = _stem(Axes.stem)
    Axes.hist, Axes.hist2d = renamed(Axes.hist, normed="density"), renamed(Axes.hist2d, normed="density")
    Axes.imshow = positional(Axes.imshow, "self", *_IMSHOW)
    Axes.scatter = without(Axes.scatter, "verts")
    _artists(Axes)
    from matplotlib.axes import _base

    lines = _base._process_plot_var_args
    if "prop_cycler" not in lines.set_prop_cycle.__code__.co_names:  # Matplotlib 3.8
        lines.prop_cycler = property(_cycle)
    Axes.text = without(Axes.text, "withdash")
    for name in ("is_first_col", "is_first_row", "is_last_col", "is_last_row", "get_geometry"):

        def ask(self, _name=name):
            place = self.get_subplotspec()
            return getattr(place, _name)() if _name != "get_geometry" else (*place.get_geometry()[:2], place.num1 + 1)

        add(Axes, **{name: ask})

    def change_geometry(self, numrows, numcols, num):
        from matplotlib.gridspec import GridSpec

        self.set_subplotspec(GridSpec(numrows, numcols, figure=self.figure)[num - 1])

    add(
        Axes,
        rowNum=property(lambda self: self.get_subplotspec().rowspan.start),
        colNum=property(lambda self: self.get_subplotspec().colspan.start),
    )
    add(Axes, change_geometry=change_geometry, hold=lambda self, b=None: None)


_IMSHOW = ("X", "cmap", "norm", "aspect", "interpolation", "alpha", "vmin", "vmax", "origin", "extent")


def _stem(function):
    """``stem(y)``, ``stem(x, y)``, and formats behind them."""
    new_stem = without(function, "use_line_collection")

    @functools.wraps(function)
    def stem(*arguments, **options):
        count = sum(not isinstance(one, str) for one in arguments)
        return new_stem(*arguments[:count], **dict(zip(("linefmt", "markerfmt", "basefmt"), arguments[count:])), **options)

    return stem


def _cycle(self):
    """``next(ax._get_lines.prop_cycler)["color"]``"""
    while True:
        yield {"color": self.get_next_color()}


def _artists(Axes):
    """``ax.lines`` and the like were lists: artists go when they are taken out or the list is another one."""
    kind = getattr(Axes, "ArtistList", None)
    if kind is None:
        return

    def pop(self, index=-1):
        artist = self[index]
        artist.remove()
        return artist

    def remove(self, value):
        if value not in list(self):
            raise ValueError("list.remove(x): x not in list")
        value.remove()

    def __delitem__(self, index):
        for artist in self[index] if isinstance(index, slice) else [self[index]]:
            artist.remove()

    if not hasattr(kind, "remove"):
        add(
            kind,
            pop=pop,
            remove=remove,
            __delitem__=__delitem__,
            clear=lambda self: self.__delitem__(slice(None)),
            append=lambda self, artist: self._axes.add_artist(artist),
        )
    for name in ("artists", "collections", "images", "lines", "patches", "tables", "texts"):
        place = getattr(Axes, name)

        def put(self, artists, _place=place):
            kept = list(artists)
            for artist in list(_place.fget(self)):
                if artist not in kept:
                    artist.remove()
            for artist in kept:
                if artist not in list(_place.fget(self)):
                    self.add_artist(artist)

        if place.fset is None:
            setattr(Axes, name, place.setter(put))


def _axis(module):
    module.Axis.grid = renamed(module.Axis.grid, b="visible")

    def of_part(name):
        return property(lambda self: getattr(self, name).get_visible(), lambda self, value: getattr(self, name).set_visible(value))

    add(
        module.Tick,
        label=property(lambda self: self.label1),
        label1On=of_part("label1"),
        label2On=of_part("label2"),
        tick1On=of_part("tick1line"),
        tick2On=of_part("tick2line"),
        gridOn=of_part("gridline"),
    )


def _lines(module):
    """A point is a line of one number."""
    for name in ("set_xdata", "set_ydata"):

        def put(self, values, _new=getattr(module.Line2D, name)):
            return _new(self, values if hasattr(values, "__iter__") else [values])

        setattr(module.Line2D, name, functools.wraps(getattr(module.Line2D, name))(put))


def _patches(module):
    """Arrows in space as courses draw them project themselves when they are drawn: ``proj_transform(x, y, z, renderer.M)``."""
    add(module.Patch, do_3d_projection=lambda self, renderer=None: 0.0)
    for cls, names in (
        ("Arc", "xy width height angle theta1 theta2"),
        ("Ellipse", "xy width height angle"),
        ("Polygon", "xy closed"),
        ("Rectangle", "xy width height angle"),
        ("RegularPolygon", "xy numVertices radius orientation"),
        ("Wedge", "center r theta1 theta2 width"),
        ("Arrow", "x y dx dy width"),
    ):
        cls = getattr(module, cls)
        cls.__init__ = positional(cls.__init__, "self", *names.split())


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
    add(
        module,
        register_cmap=lambda name=None, cmap=None, **_options: module.colormaps.register(cmap, name=name),
        hold=lambda b=None: None,
        ishold=lambda: True,
    )
    module.grid = renamed(module.grid, b="visible")
    module.annotate = renamed(module.annotate, s="text")
    module.stem = _stem(module.stem)
    module.hist, module.hist2d = renamed(module.hist, normed="density"), renamed(module.hist2d, normed="density")
    module.imshow = positional(module.imshow, *_IMSHOW)
    module.subplots = positional(module.subplots, "nrows", "ncols", "sharex", "sharey", "squeeze", "subplot_kw", "gridspec_kw")


def _style(module):
    """``seaborn-whitegrid`` is called ``seaborn-v0_8-whitegrid`` now."""
    for name in [name for name in module.library if name.startswith("seaborn-v0_8")]:
        module.library.setdefault("seaborn" + name[len("seaborn-v0_8") :], module.library[name])
    new_use = module.use

    @functools.wraps(new_use)
    def use(style):
        if isinstance(style, str) and style.startswith("seaborn") and style in module.library:
            style = module.library[style]
        return new_use(style)

    module.use = use


COMPLETE = {
    "matplotlib": _matplotlib,
    "matplotlib.axes": _axes,
    "matplotlib.axis": _axis,
    "matplotlib.backend_bases": _canvas,
    "matplotlib.backends.backend_agg": _agg,
    "matplotlib.cbook": _cbook,
    "matplotlib.cm": _cm,
    "matplotlib.colorbar": _colorbar,
    "matplotlib.colors": _colors,
    "matplotlib.contour": _contour,
    "matplotlib.dates": _dates,
    "matplotlib.figure": _figure,
    "matplotlib.lines": _lines,
    "matplotlib.patches": _patches,
    "matplotlib.pyplot": _pyplot,
    "matplotlib.scale": _scale,
    "matplotlib.style": _style,
    "matplotlib.widgets": _widgets,
    "mpl_toolkits.mplot3d.axes3d": _axes3d,
}
