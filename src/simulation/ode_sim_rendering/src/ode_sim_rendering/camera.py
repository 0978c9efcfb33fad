"""What a camera is: a frozen record, read from the ``<camera>`` element of a sensor or written by hand."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from ode_sim.description.model import FARTHEST, Pose, Vec3, quoted
from ode_sim.description.xmlsource import is_true, leading_numbers
from ode_sim.errors import CameraError
from ode_sim.math3 import compose, from_rpy

MAX_SIZE = 8192  # pixels along a side; llvmpipe's largest texture is 16384, and a frame of 8192x8192 is 268 MB
_MAX_PIXELS = 64_000_000
_NOISIEST = 1e3  # noise is in fractions of full scale
_BENT = 1e6  # of lens coefficients

LENS_FUNCTIONS: dict[str, Callable[[float], float]] = {"sin": math.sin, "tan": math.tan, "id": float}
_LENSES = {
    "gnomonical": (1.0, 1.0, "tan"),
    "stereographic": (2.0, 2.0, "tan"),
    "equidistant": (1.0, 1.0, "id"),
    "equisolid_angle": (2.0, 2.0, "sin"),
    "orthographic": (1.0, 1.0, "sin"),
}  # c1, c2, fun
_TEXTURES = (16, 2048)  # pixels
STEEPEST = math.radians(80)  # of a lidar's ray that a picture shows

ENCODINGS = {
    "L8": "mono8",
    "L_INT8": "mono8",
    "L16": "mono16",
    "L_INT16": "mono16",
    "R8G8B8": "rgb8",
    "RGB_INT8": "rgb8",
    "B8G8R8": "bgr8",
    "BGR_INT8": "bgr8",
    "R16G16B16": "rgb16",
    "RGB_INT16": "rgb16",
    "BAYER_RGGB8": "bayer_rggb8",
    "BAYER_BGGR8": "bayer_bggr8",
    "BAYER_GBRG8": "bayer_gbrg8",
    "BAYER_GRBG8": "bayer_grbg8",
}


@dataclass(frozen=True)
class Distortion:
    """Brown's lens model with OpenCV's meaning of the coefficients: ``k1 k2 k3`` radial, ``p1 p2`` tangential;
    ``center`` in fractions of the image. ``crop``: no black border, the picture is filled with what is really there."""

    k1: float = 0.0
    k2: float = 0.0
    k3: float = 0.0
    p1: float = 0.0
    p2: float = 0.0
    center: tuple[float, float] = (0.5, 0.5)
    crop: bool = True

    def __bool__(self) -> bool:
        return any((self.k1, self.k2, self.k3, self.p1, self.p2))


@dataclass(frozen=True)
class WideLens:
    """A lens that sees far aside, as of a ``wideanglecamera``: what stands at ``angle`` (rad) from the optical axis is
    ``c1 * f * fun(angle / c2 + c3)`` from the middle of the picture, in halves of its width. ``fun``: sin, tan or id.

    :param cutoff: rad; black beyond. :param texture: pixels along each picture from which the wide one is made.
    """

    c1: float = 2.0
    c2: float = 2.0
    c3: float = 0.0
    f: float = 1.0
    fun: str = "tan"
    cutoff: float = 1.5707
    texture: int = 256

    def __post_init__(self) -> None:
        if self.fun not in LENS_FUNCTIONS:
            raise CameraError(f"<fun> of the lens is '{quoted(self.fun)}'; use one of {', '.join(LENS_FUNCTIONS)}")
        if not all(abs(value) <= _BENT for value in (self.c1, self.c2, self.c3, self.f)) or not self.c1 * self.c2 * self.f:
            raise CameraError(
                f"lens of c1 {self.c1:g}, c2 {self.c2:g}, c3 {self.c3:g}, f {self.f:g}; each must be finite and at most "
                f"{_BENT:g}, and all but c3 other than 0"
            )
        if not 0 <= self.cutoff <= _BENT:
            raise CameraError(f"<cutoff_angle> of the lens is {self.cutoff:g} rad; it must not be negative")


@dataclass(frozen=True)
class Camera:
    """A pinhole, or a wide-angle lens, that looks along +x, with +y to the left and +z up.

    :param width, height: pixels. :param hfov: horizontal field of view, rad. :param near, far: clip distances, m.
    :param format: SDF pixel format, see :data:`ENCODINGS`.
    :param noise_mean, noise_stddev: of the Gaussian added to each pixel, in fractions of full scale.
    :param pose: X_LC in the frame of ``link``, or X_WC when ``link`` is empty. :param link: scoped, ``model::link``.
    """

    name: str = "camera"
    width: int = 320
    height: int = 240
    hfov: float = 1.047
    near: float = 0.1
    far: float = 100.0
    format: str = "R8G8B8"
    noise_mean: float = 0.0
    noise_stddev: float = 0.0
    distortion: Distortion = Distortion()
    pose: Pose = Pose()
    link: str = ""
    lens: WideLens | None = None

    def __post_init__(self) -> None:
        if not (1 <= self.width <= MAX_SIZE and 1 <= self.height <= MAX_SIZE) or self.width * self.height > _MAX_PIXELS:
            raise CameraError(
                f"image of {self.width}x{self.height} pixels; width and height must be 1 to {MAX_SIZE}, "
                f"together at most {_MAX_PIXELS // 1_000_000} million pixels"
            )
        if self.lens is None and not 1e-3 <= self.hfov <= math.radians(175):
            raise CameraError(f"horizontal_fov {self.hfov:g} rad; it must be between 0.001 and 3.05")
        if self.lens is not None and not 0.01 <= self.hfov <= 2 * math.pi:
            raise CameraError(f"horizontal_fov {self.hfov:g} rad; that of a wideanglecamera must be between 0.01 and 6.28")
        if not 0 < self.near < self.far < math.inf:
            raise CameraError(f"clip near {self.near:g} m, far {self.far:g} m; near must be above 0 and below far")
        if self.format not in ENCODINGS:
            raise CameraError(f"unknown image format '{quoted(self.format)}'; use one of {', '.join(ENCODINGS)}")
        if not (0 <= self.noise_stddev <= _NOISIEST and abs(self.noise_mean) <= _NOISIEST):
            raise CameraError(
                f"noise mean {self.noise_mean:g}, stddev {self.noise_stddev:g}; stddev must not be negative, "
                f"neither may be above {_NOISIEST:g} of full scale"
            )
        lens = self.distortion
        if not all(abs(value) <= _BENT for value in (lens.k1, lens.k2, lens.k3, lens.p1, lens.p2, *lens.center)):
            raise CameraError(
                f"distortion of {lens.k1:g} {lens.k2:g} {lens.k3:g} {lens.p1:g} {lens.p2:g} about "
                f"{lens.center[0]:g} {lens.center[1]:g}; each must be finite and at most {_BENT:g}"
            )

    @property
    def focal_length(self) -> float:
        """Pixels; the same along both axes. As in Gazebo that of a pinhole, also where a lens sees farther aside."""
        return self.width / (2.0 * math.tan(self.hfov / 2.0))

    @property
    def encoding(self) -> str:
        """sensor_msgs name of :attr:`format`."""
        return ENCODINGS[self.format]

    def project(self, p_C: np.ndarray) -> np.ndarray:
        """Pixel coordinates (N,2) (column, row; whole numbers at pixel centres) of points ``p_C`` (N,3), m, in the camera frame."""
        p_C = np.atleast_2d(np.asarray(p_C, float))
        f = self.focal_length
        return np.stack([(self.width - 1) / 2 - f * p_C[:, 1] / p_C[:, 0], (self.height - 1) / 2 - f * p_C[:, 2] / p_C[:, 0]], axis=1)

    def projection(self, width: int, height: int) -> np.ndarray:
        """(4,4): clip coordinates from the camera frame (x forward, y left, z up) for ``width`` x ``height`` pixels, rows downwards."""
        f, near, far = self.focal_length, self.near, self.far
        return np.array(
            [
                [0, -2 * f / width, 0, 0],
                [0, 0, -2 * f / height, 0],
                [(far + near) / (far - near), 0, 0, -2 * far * near / (far - near)],
                [1, 0, 0, 0],
            ]
        )


@dataclass(frozen=True)
class Fan:
    """Of a lidar: ``yaws`` (H,) and ``pitches`` (V,) of the rays, rad, each in rising order.

    :raises CameraError: rays that no pictures show: steeper than :data:`STEEPEST`, or more than a turn of them.
    """

    yaws: tuple[float, ...]
    pitches: tuple[float, ...]

    def __post_init__(self) -> None:
        steepest, extent = max(map(abs, self.pitches)), self.yaws[-1] - self.yaws[0]
        if extent < 0 or self.pitches[-1] < self.pitches[0]:
            raise CameraError("its angles fall from <min_angle> to <max_angle>; pictures show those that rise")
        if steepest > STEEPEST or extent > 2 * math.pi + 1e-6:
            raise CameraError(
                f"rays of {math.degrees(steepest):.0f} degrees up or down over {math.degrees(extent):.0f} degrees; "
                f"pictures show at most {math.degrees(STEEPEST):.0f} over a turn"
            )


def _number(element: ET.Element | None, path: str, default: float) -> float:
    text = element.findtext(path) if element is not None else None
    if text is None or not text.strip():
        return default
    values = leading_numbers(text, 1)
    if not values:
        raise CameraError(f"<{path.rpartition('/')[2]}> is '{quoted(text)}', not a number")
    return values[0]


def _pixels(element: ET.Element | None, path: str, default: int) -> int:
    value = _number(element, path, default)
    if not math.isfinite(value):
        raise CameraError(f"<{path.rpartition('/')[2]}> is {value}, not a number of pixels")
    return int(value)


def _pose(text: str | None) -> Pose:
    """Of the six numbers of a ``<pose>`` (m, rad); missing ones are 0."""
    values = leading_numbers(text or "", 6)
    if not all(abs(value) <= FARTHEST for value in values):
        raise CameraError(f"<pose> is '{quoted(text)}'; six finite numbers are needed, of at most {FARTHEST:g}")
    return from_rpy(*values)


def read_distortion(element: ET.Element | None) -> Distortion:
    """From a ``<distortion>`` element (None: no distortion)."""
    text = (element.findtext("center") if element is not None else None) or "0.5 0.5"
    center = leading_numbers(text, 2)
    center += (0.5, 0.5)[len(center) :]
    k1, k2, k3, p1, p2 = (_number(element, key, 0.0) for key in ("k1", "k2", "k3", "p1", "p2"))
    return Distortion(k1, k2, k3, p1, p2, center=(center[0], center[1]))


def read_lens(element: ET.Element | None, hfov: float) -> WideLens:
    """From a ``<lens>`` ``element`` (None: stereographic) of a camera of horizontal field of view ``hfov``, rad.

    :raises CameraError: a value that no lens can have.
    """
    kind = (element.findtext("type") if element is not None else None) or "stereographic"
    kind = kind.strip()
    if kind == "custom":
        c1, c2, c3, f = (_number(element, f"custom_function/{key}", 0.0 if key == "c3" else 1.0) for key in ("c1", "c2", "c3", "f"))
        fun = ((element.findtext("custom_function/fun") if element is not None else None) or "tan").strip()
    elif kind in _LENSES:
        (c1, c2, fun), c3, f = _LENSES[kind], 0.0, 1.0
    else:
        raise CameraError(f"unknown <type> of lens '{quoted(kind)}'; use one of {', '.join(_LENSES)}, custom")
    texture = min(max(_pixels(element, "env_texture_size", 256), _TEXTURES[0]), _TEXTURES[1])
    lens = WideLens(c1, c2, c3, f, fun, _number(element, "cutoff_angle", 1.5707), texture)
    if is_true((element.findtext("scale_to_hfov") if element is not None else None) or "true"):
        at_edge = c1 * LENS_FUNCTIONS[fun](hfov / 2 / c2 + c3)
        if not at_edge > 0:
            raise CameraError(f"the lens cannot be scaled to a horizontal_fov of {hfov:g} rad: it is not seen by it")
        lens = replace(lens, f=1.0 / at_edge)
    return lens


def read_camera(
    element: ET.Element, sensor_pose: Pose = Pose(), link: str = "", name: str = "", image_format: str = "", wide: bool = False
) -> Camera:
    """A camera from the ``<camera>`` element of a sensor.

    :param sensor_pose: X_LS of the sensor in its link. :param link: scoped link name.
    :param image_format: instead of the element's own. :param wide: its ``<lens>`` counts, as that of a wideanglecamera.
    :raises CameraError: a value that no camera can have.
    """
    pose = compose(sensor_pose, _pose(element.findtext("pose")))
    noise = element.find("noise")
    hfov = _number(element, "horizontal_fov", 1.047)
    noisy = noise is not None and (noise.findtext("type") or noise.get("type") or "gaussian").strip() != "none"
    return Camera(
        name=name or element.get("name") or "camera",
        width=_pixels(element, "image/width", 320),
        height=_pixels(element, "image/height", 240),
        hfov=hfov,
        near=_number(element, "clip/near", 0.1),
        far=_number(element, "clip/far", 100.0),
        format=image_format or (element.findtext("image/format") or "R8G8B8").strip(),
        noise_mean=_number(noise, "mean", 0.0) if noisy else 0.0,
        noise_stddev=_number(noise, "stddev", 0.0) if noisy else 0.0,
        distortion=read_distortion(element.find("distortion")),
        pose=pose,
        link=link,
        lens=read_lens(element.find("lens"), hfov) if wide else None,
    )


def look_at(eye: Vec3, target: Vec3) -> Pose:
    """X_WC of a camera at ``eye`` that looks at ``target`` with its horizon level (both (3,), m, world frame)."""
    forward = np.asarray(target, float) - np.asarray(eye, float)
    yaw = math.atan2(forward[1], forward[0])
    pitch = math.atan2(-forward[2], math.hypot(forward[0], forward[1]))
    x, y, z = (float(v) for v in eye)
    return from_rpy(x, y, z, 0.0, pitch, yaw)
