"""Pillow 7.1 to 11, OpenCV 4.3 to 4.10."""

import functools

from noetic_names import add, add_to_compiled, aliases, replace_in_compiled


def _image(module):
    kinds = getattr(module, "Resampling", module)
    add(module, ANTIALIAS=kinds.LANCZOS, LINEAR=kinds.BILINEAR, CUBIC=kinds.BICUBIC)


def _size(box):
    """Width and height of a text with the room left and above, which Pillow counted in."""
    return tuple(int(number) for number in box[2:])


def _draw(module):
    def textsize(self, text, font=None, spacing=4, direction=None, features=None, language=None, stroke_width=0):
        return _size(
            self.textbbox(
                (0, 0), text, font, spacing=spacing, direction=direction, features=features, language=language, stroke_width=stroke_width
            )
        )

    add(module.ImageDraw, textsize=textsize, multiline_textsize=textsize)


def _font(module):
    for name in ("FreeTypeFont", "TransposedFont", "ImageFont"):
        if hasattr(module, name):
            add(getattr(module, name), getsize=lambda self, text, *arguments, **options: _size(self.getbbox(text, *arguments, **options)))


def _cv2(module):
    legacy = getattr(module, "legacy", None)
    for name in dir(legacy) if legacy else ():
        if name.startswith(("Tracker", "MultiTracker")):
            add(module, **{name: getattr(legacy, name)})
    module.split, module.findContours = _with_lists(module.split), _with_lists(module.findContours)
    for name in ("arrowedLine", "circle", "drawMarker", "ellipse", "line", "putText", "rectangle"):
        setattr(module, name, _at_whole_pixels(getattr(module, name)))
    replace_in_compiled(module.DescriptorMatcher, match=_with_lists, knnMatch=_with_lists, radiusMatch=_with_lists)
    replace_in_compiled(module.Feature2D, detect=_with_lists, detectAndCompute=_with_lists)
    if hasattr(module, "dnn"):
        module.dnn.NMSBoxes = _as_a_column(module.dnn.NMSBoxes)
        replace_in_compiled(module.dnn.Net, getUnconnectedOutLayers=_as_a_column)
    if hasattr(module, "aruco"):
        _aruco(module, module.aruco)


def _with_lists(function):
    """What OpenCV has several of came as a list, which is sorted and whose items are replaced; now they are a tuple."""

    @functools.wraps(function)
    def call(*arguments, **options):
        found = function(*arguments, **options)
        if isinstance(found, tuple) and any(isinstance(one, tuple) for one in found):
            several = [list(one) if isinstance(one, tuple) else one for one in found]
            return several if all(isinstance(one, list) for one in several) else tuple(several)
        one_answer = isinstance(found, tuple) and function.__name__ in ("split", "match", "detect")
        return list(found) if one_answer else found

    return call


def _at_whole_pixels(function):
    """A place of ``numpy.float32`` numbers, as circles and corners are found, was cut to whole ones."""
    import numpy

    def whole(value):
        return tuple(int(one) if isinstance(one, numpy.float32) else one for one in value) if isinstance(value, tuple) else value

    @functools.wraps(function)
    def draw(*arguments, **options):
        return function(*map(whole, arguments), **{name: whole(value) for name, value in options.items()})

    return draw


def _as_a_column(function):
    """(n, 1), as ``i[0] for i in ...`` reads them; (n,) now."""

    @functools.wraps(function)
    def call(*arguments, **options):
        found = function(*arguments, **options)
        return found.reshape(-1, 1) if getattr(found, "ndim", 0) == 1 else found

    return call


def _aruco(cv2, aruco):
    aliases(
        aruco,
        Dictionary_get="getPredefinedDictionary",
        drawMarker="generateImageMarker",
        DetectorParameters_create="DetectorParameters",
        Dictionary_create="extendDictionary",
    )
    add(
        aruco,
        drawAxis=lambda *arguments: cv2.drawFrameAxes(*arguments),
        CharucoBoard_create=lambda x, y, square, marker, dictionary: aruco.CharucoBoard((x, y), square, marker, dictionary),
        GridBoard_create=lambda x, y, length, separation, dictionary, first=0: aruco.GridBoard(
            (x, y), length, separation, dictionary, *_ids(first, x * y)
        ),
    )
    if hasattr(aruco, "Board") and hasattr(aruco.Board, "generateImage"):
        add_to_compiled(
            aruco.Board,
            draw=lambda self, outSize, img=None, marginSize=0, borderBits=1: self.generateImage(outSize, img, marginSize, borderBits),
        )
    if hasattr(aruco, "ArucoDetector"):

        def detectMarkers(image, dictionary, corners=None, ids=None, parameters=None, rejectedImgPoints=None):
            return aruco.ArucoDetector(dictionary, parameters or aruco.DetectorParameters()).detectMarkers(image)

        add(aruco, detectMarkers=detectMarkers, estimatePoseSingleMarkers=lambda *arguments: _poses(cv2, *arguments))


def _ids(first, count):
    import numpy

    return (numpy.arange(first, first + count),) if first else ()


def _poses(cv2, corners, length, matrix, distortion):
    """(rotations (n, 1, 3) rad, translations (n, 1, 3) in the unit of ``length``, the markers' corners (4, 1, 3))"""
    import numpy

    half = length / 2
    points = numpy.array([[-half, half, 0], [half, half, 0], [half, -half, 0], [-half, -half, 0]], numpy.float32)
    found = [
        cv2.solvePnP(points, numpy.asarray(corner).reshape(4, 2), matrix, distortion, flags=cv2.SOLVEPNP_IPPE_SQUARE)[1:]
        for corner in corners
    ]
    rotations, translations = (numpy.array([one[k].reshape(1, 3) for one in found]) for k in (0, 1))
    return rotations, translations, points[:, None, :]


COMPLETE = {"PIL.Image": _image, "PIL.ImageDraw": _draw, "PIL.ImageFont": _font, "cv2": _cv2}
