"""The messages are those of geographic_msgs 0.5: programs and bags of others understand them."""

import pytest
from geographic_msgs import msg, srv

SUMS = dict(
    line.split()
    for line in """
BoundingBox f62e8b5e390a3ac7603250d46e8f8446
GeoPath 1476008e63041203a89257cfad97308f
GeoPoint c48027a852aeff972be80478ff38e81a
GeoPointStamped ea50d268b03080563c330351a21edc89
GeoPose 778680b5172de58b7c057d973576c784
GeoPoseStamped cc409c8ed6064d8a846fa207bf3fba6b
GeoPoseWithCovariance 84c133e7220362d3d8aff8e415075357
GeoPoseWithCovarianceStamped 2cc818b24aae5ffa4fd33f5ee0bb5421
GeographicMap 0f4ce6d2ebf9ac9c7c4f3308f6ae0731
GeographicMapChanges 4fd027f54298203ec12aa1c4b20e6cb8
KeyValue cf57fdc6617a881a88c16e768132149c
MapFeature e2505ace5e8da8a15b610eaf62bdefae
RouteNetwork fd717c0a34a7c954deed32c6847f30a8
RoutePath 0aa2dd809a8091bdb4466dfefecbb8cf
RouteSegment 8583d1e2ddf1891c3934a5d2ed9a799c
WayPoint ef04f823aef332455a49eaec3f1761b7
GetGeoPath ee0dbd181711a70f823cc5d415fa609b
GetGeographicMap c0278e653eee0ad79600510650e7be39
GetRoutePlan 04479050c4f2a58d915ceec419e70b4e
UpdateGeographicMap 93db3f1ec099e9f1b7e442d7d397e244
""".split("\n")
    if line
)


@pytest.mark.parametrize("name", SUMS)
def test_sum(name):
    assert getattr(msg if hasattr(msg, name) else srv, name)._md5sum == SUMS[name]


def test_all():
    assert {
        name
        for module in (msg, srv)
        for name in vars(module)
        if hasattr(getattr(module, name), "_md5sum") and not name.endswith(("Request", "Response"))
    } == set(SUMS)
