"""Every text is read as TinyXML itself reads it: Debian's library is asked (read_by_tinyxml.cpp)."""

import json
import os
import random
import subprocess
import time
from xml.etree import ElementTree

import lenient_xml
import pytest


def program():
    for prefix in os.environ.get("CMAKE_PREFIX_PATH", "").split(":"):
        path = os.path.join(prefix, "lib/lenient_xml/read_by_tinyxml")
        if os.path.isfile(path):
            return path
    pytest.fail("read_by_tinyxml is not built: libtinyxml-dev is missing, or the package was built without tests")


def asked(texts):
    """What TinyXML makes of each text: None, or a list of elements."""
    given = b"".join(text.encode() + b"\0" for text in texts)
    said = subprocess.run([program()], input=given, capture_output=True, timeout=60)
    assert said.returncode == 0, said
    return [json.loads(line) for line in said.stdout.splitlines()]


class Tree:
    """Elements as read_by_tinyxml prints them: [tag, line, attributes, text before the first child, children...]."""

    def __init__(self):
        self.roots, self._stack = [], []

    def start(self, tag, attrib, line):
        element = [tag, line, attrib, None]
        (self._stack[-1] if self._stack else self.roots).append(element)
        self._stack.append(element)

    def end(self, tag):
        assert self._stack.pop()[0] == tag

    def data(self, text):
        if len(self._stack[-1]) == 4:
            self._stack[-1][3] = (self._stack[-1][3] or "") + text


def read(text):
    tree = Tree()
    try:
        lenient_xml.feed(text, tree)
    except lenient_xml.XmlError:
        return None
    return tree.roots


def as_bytes(element):
    """Code points of an answer are bytes of UTF-8."""
    tag, line, attributes, text, *children = element
    return [
        decoded(tag),
        line,
        {decoded(k): decoded(v) for k, v in attributes.items()},
        None if text is None else decoded(text),
        *map(as_bytes, children),
    ]


def decoded(text):
    return text.encode("latin-1").decode("utf-8", "replace")


def same(mine, theirs):
    """TinyXML's text ends at a comment, and its white space is condensed."""
    if mine is None or theirs is None:
        return mine is theirs
    return len(mine) == len(theirs) and all(_same(a, b) for a, b in zip(mine, map(as_bytes, theirs)))


def _same(a, b):
    text = " ".join((a[3] or "").split())
    return (
        a[0] == b[0]
        and a[1] == b[1]
        and a[2] == b[2]
        and (b[3] is None or text.startswith(" ".join(b[3].split())))
        and len(a) == len(b)
        and all(_same(x, y) for x, y in zip(a[4:], b[4:]))
    )


TEXTS = [
    '<a b="1" b="2"/>',
    "<a b=1 c=2/>",
    "<a b=x/y>t</a>",
    "<a b>t</a>",
    "<a b='1'c='2'/>",
    '<a b = "1" />',
    '<a b=""/>',
    "<a b= />",
    '<a b="x&y<z">q & r &amp; s &foo; &#65; &#x42;</a>',
    "<a>&#xZZ;</a>",
    "<a>&#65</a>",
    "<a b='&LT; &amp'/>",
    "<a>http://h/x?a=1&b=2</a>",
    "<a/><b/>",
    "<a/>text<b/>",
    "text<a/>",
    "<a>x<b/>y</a>",
    "<a>x <!-- c -- d --> y</a>",
    "<a><!-- x</a>",
    "<!-- x",
    "<a b='<!-- x -->'/>",
    "<a><b></a></b>",
    "<a><b></b>",
    "<a>",
    "<a></a >",
    "<a></ab>",
    "<A></a>",
    "< a/>",
    "<1a/>",
    "<a/ >",
    "<a / >",
    "</a>",
    "<a></a><",
    "<",
    "<a><5 b></a>",
    "<a>1 < 2</a>",
    "<a b='x\"y'/>",
    '<a b="x/>',
    '<a b=x"y/>',
    '<?xml version="1.0"?>\n\n<a/>',
    '\n<?xml version="1.0"?><a/>',
    "<?xml version='1.0' encoding='latin-15'?><a/>",
    "<!DOCTYPE a><a/>",
    "<a><![CDATA[x<y & z]]></a>",
    "<a><![CDATA[x</a>",
    "\ufeff<a/>",
    "<a>\u00e9</a>",
    "<\u00e9 \u00fc='\u00df'/>",
    '<a b="\n1\t2 "> x \n y </a>',
    "<a:b c:d='1'/>",
    "<a.b-c_d/>",
    "<a><?pi x?><b/></a>",
    "<a>\x01</a>",
    "<a\n b='1'\n><c/>\n<d/></a>",
    "",
    "   ",
    "<a b='&lt;&quot;&apos;&gt;'/>",
    "<a>]]></a>",
    "<_a _b='1'/>",
    "<a\tb='1'\rc='2'/>",
]


@pytest.mark.parametrize("number", range(len(TEXTS)), ids=[text[:20].encode("unicode_escape").decode() for text in TEXTS])
def test_a_text_is_read_as_tinyxml_reads_it(number):
    assert same(read(TEXTS[number]), asked([TEXTS[number]])[0]), (read(TEXTS[number]), asked([TEXTS[number]])[0])


PIECES = [
    "<a>",
    "</a>",
    "<b c='1'>",
    "</b>",
    "<d/>",
    "<",
    ">",
    "/>",
    "/",
    "=",
    "'",
    '"',
    "&",
    "&amp;",
    "&#65;",
    "&x;",
    "<!--",
    "-->",
    "--",
    "]]>",
    "<![CDATA[",
    "<?xml ?>",
    "<!x>",
    " ",
    "\n",
    "x",
    "e f=g",
    " h='<&'",
    "\u00e9",
    "1",
]


def test_texts_at_random_are_read_as_tinyxml_reads_them():
    random.seed(36)
    texts = ["".join(random.choices(PIECES, k=random.randint(1, 14))) for _ in range(4000)]
    texts += ["<a>" + "".join(random.choices(PIECES, k=random.randint(1, 8))) + "</a>" for _ in range(4000)]
    wrong = [(text, read(text), answer) for text, answer in zip(texts, asked(texts)) if not same(read(text), answer)]
    assert not wrong, wrong[:5]


@pytest.mark.parametrize(
    "text",
    [
        "<!--" * 300_000,
        "<a>" * 50_000,
        "&" * 1_000_000,
        "<a b='" * 200_000,
        "<a " * 300_000,
        "\n" * 1_000_000,
        "<a>" + "<" * 500_000,
        "<a>" + "\n<b c=d/>" * 30_000,
        "<a>" + "&#x" * 300_000,
    ],
    ids=lambda text: text[:12],
)
def test_any_text_takes_linear_time(text):
    def seconds(part):
        began = time.process_time()
        read(part)
        return time.process_time() - began

    assert seconds(text) < 40 * max(seconds(text[: len(text) // 10]), 0.01)


def test_what_was_read_otherwise_than_written_is_told_with_its_line():
    class Nothing:
        start = end = data = lambda self, *_: None

    assert lenient_xml.feed("<a>\n<b c='x & y'/>\n<d e=1 f='<'/></a>", Nothing()) == [
        (2, "a bare '&' is dropped (it is written &amp;)"),
        (3, "attribute 'e' of <d> has no quotation marks"),
        (3, "'<' in attribute 'f' of <d> is part of the value"),
    ]


def test_the_root_that_is_asked_for_is_found_behind_others():
    assert lenient_xml.fromstring("<x/><robot name='r'/><robot name='s'/>").get("name") == "r"
    root = lenient_xml.fromstring("\n<?xml version='1.0'?><robot name='a &amp; b'><link name='1&2'/></robot>")
    assert root.get("name") == "a & b" and root.find("link").get("name") == "12"
    with pytest.raises(ElementTree.ParseError, match="line 2"):
        lenient_xml.fromstring("<robot>\n<link></robot>")
    with pytest.raises(ElementTree.ParseError):
        lenient_xml.fromstring("robot")
