"""Images of bags as pictures. Messages of bags have classes of their own, made from the definitions in the file."""

from __future__ import annotations

import numpy as np
from PIL import Image
from rqt_image_view.pictures import DepthView
from rqt_image_view.source import picture_of


def picture(message) -> np.ndarray:
    """(h, w) or (h, w, 3) RGB uint8; depth from its nearest to its farthest point.

    :raises rqt_image_view.pictures.PictureError: it cannot be shown; one line that says why.
    """
    return picture_of(message, DepthView(dynamic=True))


def imgmsg_to_pil(img_msg, rgba: bool = True) -> Image.Image:
    """``img_msg`` as a PIL image; the name that views of others import.

    :param rgba: with an alpha channel.
    """
    made = Image.fromarray(picture(img_msg))
    return made.convert("RGBA") if rgba else made
