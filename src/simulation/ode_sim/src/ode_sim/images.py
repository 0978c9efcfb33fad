"""Pictures from files that nobody has checked: textures, height maps, floor plans."""

from __future__ import annotations

import logging
import os
import warnings
from collections.abc import Callable

import numpy as np

from ode_sim.description.model import DescriptionError, one_line

logging.getLogger("PIL").setLevel(logging.CRITICAL)  # what it logs, it raises as well

MOST_PIXELS = 64_000_000
#: Those that Gazebo's graphics read. Left to itself, Pillow would start Ghostscript for a PostScript file.
_FORMATS = ("PNG", "JPEG", "BMP", "TIFF", "TGA", "GIF", "PPM", "WEBP", "DDS")


def read_rgba(path: str, most: int = MOST_PIXELS) -> np.ndarray:
    """(H, W, 4) uint8 of the file ``path``, first row at the top.

    :param most: pixels that the caller can make use of.
    :raises DescriptionError: one line that names the file: no image, a broken one, or one of too many pixels.
    """
    return _pixels(path, lambda mode: "RGBA", most)


def read_relief(path: str, most: int = MOST_PIXELS) -> np.ndarray:
    """(H, W) float64 of the file ``path`` from 0 (black) to 1, first row at the top; of 16 bits where the file has them.

    Of a picture in colours, blue is what counts, as in Gazebo (``scripts/truth compare heightmap_tinted``).

    :param most: as for :func:`read_rgba`.
    :raises DescriptionError: as :func:`read_rgba`.
    """
    pixels = _pixels(path, lambda mode: "I" if mode.startswith("I") else "L" if mode in ("1", "L", "LA") else "RGB", most)
    if pixels.ndim == 3:
        pixels = pixels[..., 2]
    return np.clip(pixels / (255.0 if pixels.dtype == np.uint8 else 65535.0), 0.0, 1.0)


def _pixels(path: str, mode_for: Callable[[str], str], most: int) -> np.ndarray:
    from PIL import Image

    # Pillow would warn on the terminal: of what is broken but can be read, and of a size that it refuses at the double
    warnings.filterwarnings("ignore", category=UserWarning, module=r"PIL\.")
    warnings.filterwarnings("error", category=Image.DecompressionBombWarning)
    too_large = DescriptionError(f"image {path}: has more than {most:_} pixels; scale it down".replace("_", " "))
    if os.path.exists(path) and not os.path.isfile(path):
        raise DescriptionError(f"image {path}: is no file")  # a pipe would be waited for
    try:
        with Image.open(path, formats=_FORMATS) as image:
            if image.width * image.height > most:
                raise too_large
            return np.asarray(image.convert(mode_for(image.mode)))
    except DescriptionError:
        raise
    except (Image.DecompressionBombError, Image.DecompressionBombWarning):
        raise too_large from None
    except Image.UnidentifiedImageError:
        raise DescriptionError(f"image {path}: is no image that can be read; use png or jpg") from None
    except OSError as error:
        raise DescriptionError(f"image {path}: {error.strerror or 'is broken, ' + one_line(error, 100)}") from None
    except Exception as error:  # a decoder fed with a broken file may raise anything
        raise DescriptionError(f"image {path}: is broken, {one_line(error, 100) or type(error).__name__}") from None
