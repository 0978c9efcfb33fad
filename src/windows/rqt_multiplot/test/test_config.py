"""Files of rqt_multiplot: read as they are found, written with the same bytes."""

import pytest
from rqt_multiplot.config import (
    ConfigError,
    Curve,
    DataType,
    FieldType,
    Plot,
    ScaleType,
    StyleType,
    Table,
    TitleType,
    automatic_color,
    read,
    read_curve,
    write,
    write_curve,
)
from rqt_multiplot.urls import UrlError, to_path, to_url

#: what rqt_multiplot 0.0.11 writes for a table of one plot with one curve
FILE = """<?xml version="1.0" encoding="UTF-8"?>
<rqt_multiplot>
    <table>
        <background_color>#ffffff</background_color>
        <foreground_color>#000000</foreground_color>
        <link_cursor>true</link_cursor>
        <link_scale>false</link_scale>
        <plots>
            <row_0>
                <column_0>
                    <axes>
                        <axes>
                            <x_axis>
                                <custom_title>Untitled Axis</custom_title>
                                <title_type>0</title_type>
                                <title_visible>true</title_visible>
                            </x_axis>
                            <y_axis>
                                <custom_title>position &lt;rad&gt;</custom_title>
                                <title_type>1</title_type>
                                <title_visible>true</title_visible>
                            </y_axis>
                        </axes>
                    </axes>
                    <curves>
                        <curve_0>
                            <axes>
                                <x_axis>
                                    <field></field>
                                    <field_type>1</field_type>
                                    <scale>
                                        <absolute_maximum>1000</absolute_maximum>
                                        <absolute_minimum>0</absolute_minimum>
                                        <relative_maximum>0</relative_maximum>
                                        <relative_minimum>-10.5</relative_minimum>
                                        <type>2</type>
                                    </scale>
                                    <topic>/arm/joint_states</topic>
                                    <type>sensor_msgs/JointState</type>
                                </x_axis>
                                <y_axis>
                                    <field>position/0</field>
                                    <field_type>0</field_type>
                                    <scale>
                                        <absolute_maximum>3.14</absolute_maximum>
                                        <absolute_minimum>0</absolute_minimum>
                                        <relative_maximum>0</relative_maximum>
                                        <relative_minimum>-1000</relative_minimum>
                                        <type>1</type>
                                    </scale>
                                    <topic>/arm/joint_states</topic>
                                    <type>sensor_msgs/JointState</type>
                                </y_axis>
                            </axes>
                            <color>
                                <custom_color>#ff8800</custom_color>
                                <type>1</type>
                            </color>
                            <data>
                                <circular_buffer_capacity>1000</circular_buffer_capacity>
                                <time_frame_length>40</time_frame_length>
                                <type>3</type>
                            </data>
                            <style>
                                <lines_interpolate>false</lines_interpolate>
                                <pen_style>1</pen_style>
                                <pen_width>2</pen_width>
                                <render_antialias>true</render_antialias>
                                <steps_invert>false</steps_invert>
                                <sticks_baseline>0</sticks_baseline>
                                <sticks_orientation>2</sticks_orientation>
                                <type>2</type>
                            </style>
                            <subscriber_queue_size>100</subscriber_queue_size>
                            <title>base</title>
                        </curve_0>
                    </curves>
                    <legend>
                        <visible>true</visible>
                    </legend>
                    <plot_rate>30</plot_rate>
                    <title>joint &amp; positions</title>
                </column_0>
            </row_0>
        </plots>
        <track_points>false</track_points>
    </table>
</rqt_multiplot>
"""


def test_a_file_of_upstream():
    table, problems = read(FILE)
    plot = table.plots[0][0]
    curve = plot.curves[0]
    assert not problems and table.shape == (1, 1) and table.link_cursor and not table.link_scale
    assert plot.title == "joint & positions" and plot.plot_rate == 30.0
    assert plot.axis_title("x_axis") == "/arm/joint_states/receipt_time" and plot.axis_title("y_axis") == "position <rad>"
    assert curve.complete and curve.axes.x_axis.field_type == FieldType.RECEIPT_TIME
    assert curve.axes.x_axis.scale.type == ScaleType.RELATIVE and curve.axes.x_axis.scale.relative_minimum == -10.5
    assert curve.axes.y_axis.field == "position/0" and curve.axes.y_axis.scale.absolute_maximum == 3.14
    assert curve.data.type == DataType.TIME_FRAME and curve.data.time_frame_length == 40.0
    assert curve.style.type == StyleType.STEPS and curve.style.pen_width == 2 and curve.style.render_antialias
    assert curve.color.custom_color == "#ff8800" and curve.subscriber_queue_size == 100


def test_a_file_is_written_with_the_same_bytes():
    assert write(read(FILE)[0]) == FILE


def test_tables_come_back():
    table = Table(
        track_points=True,
        plots=[[Plot(title=f"{r} {c}", curves=[Curve(title=str(i)) for i in range(r * c + 11 * c)]) for c in range(3)] for r in range(2)],
    )
    assert read(write(table)) == (table, [])


def test_what_a_file_lacks_is_as_upstream_takes_it():
    table, problems = read(
        "<rqt_multiplot><table><plots><row_0><column_0><curves><curve_0/></curves></column_0></row_0></plots></table></rqt_multiplot>"
    )
    plot = table.plots[0][0]
    assert not problems and plot.plot_rate == 30 and plot.legend.visible and plot.axes.axes.x_axis.title_type == TitleType.AUTO
    assert plot.curves[0].data.circular_buffer_capacity == 10_000 and plot.curves[0].style.pen_width == 1
    assert read("<rqt_multiplot><table/></rqt_multiplot>")[0].shape == (1, 1)


def test_rows_of_different_lengths_are_filled_up():
    table, _ = read(
        "<rqt_multiplot><table><plots><row_0><column_0><title>a</title></column_0></row_0><row_10><column_0/>"
        "<column_1><title>d</title></column_1></row_10><row_2/></plots></table></rqt_multiplot>"
    )
    assert [[plot.title for plot in row] for row in table.plots] == [
        ["a", "Untitled Plot"],
        ["Untitled Plot", "Untitled Plot"],
        ["Untitled Curve", "d"],
    ]


@pytest.mark.parametrize(
    "old, new, said",
    [
        ("<plot_rate>30<", "<plot_rate>fast<", "row_0/column_0/plot_rate: 'fast' is no number; 30 is taken"),
        ("<plot_rate>30<", "<plot_rate>0<", "plot_rate: 0 is outside its range"),
        ("<plot_rate>30<", "<plot_rate>nan<", "plot_rate: nan is outside"),
        ("<pen_width>2<", "<pen_width>-1<", "curve_0/style/pen_width: -1 is outside its range of 0 to 100; 1 is taken"),
        ("<type>3<", "<type>7<", "curve_0/data/type"),
        ("#ff8800", "url(x)", "custom_color: 'url(x)' is no colour"),
        ("<relative_minimum>-10.5<", "<relative_minimum>inf<", "relative_minimum: inf is outside"),
    ],
)
def test_values_that_make_no_sense(old, new, said):
    assert old in FILE
    table, problems = read(FILE.replace(old, new, 1), "my.xml")
    assert len(problems) == 1 and said in problems[0] and problems[0].startswith("my.xml: ") and table.plots[0][0].curves


@pytest.mark.parametrize(
    "text, said",
    [
        ("", "is no XML file"),
        ("<rqt_multiplot><table>", "is no XML file"),
        ("<robot/>", "lacks <rqt_multiplot><table>"),
        ("<rqt_multiplot/>", "lacks"),
        ("\x00", "is no XML file"),
        (
            "<rqt_multiplot><table><plots>"
            + "".join(f"<row_{i}><column_0/></row_{i}>" for i in range(101))
            + "</plots></table></rqt_multiplot>",
            "101 x 1 plots; at most 100",
        ),
    ],
)
def test_other_files_are_refused(text, said):
    with pytest.raises(ConfigError) as error:
        read(text, "my.xml")
    assert said in str(error.value) and "my.xml" in str(error.value) and "\n" not in str(error.value)


def test_a_curve_on_the_clipboard():
    curve = read(FILE)[0].plots[0][0].curves[0]
    assert read_curve(write_curve(curve)) == curve
    for text in ("", "hello", "<robot/>"):
        with pytest.raises(ConfigError):
            read_curve(text)


def test_automatic_colours_differ_widely():
    assert [automatic_color(i) for i in range(3)] == [(255, 0, 0), (0, 252, 255), (126, 255, 0)]
    assert len({automatic_color(i) for i in range(200)}) > 190


def test_urls(monkeypatch, tmp_path):
    monkeypatch.setenv("HOME", str(tmp_path))
    assert to_path("home://a/b.xml") == tmp_path / "a/b.xml" and str(to_path("file:///a%20b.xml")) == "/a b.xml"
    assert to_path("package://rqt_plot/package.xml").is_file() and to_path("~/x.xml") == tmp_path / "x.xml"
    assert to_url(tmp_path / "a.xml") == f"file://{tmp_path}/a.xml"
    with pytest.raises(UrlError, match="there is no package 'nowhere'"):
        to_path("package://nowhere/a.xml")
    with pytest.raises(UrlError, match="'http' is no scheme"):
        to_path("http://x/a.xml")
