"""XML from XML: elements and attributes of real files changed, doubled, dropped, moved, nested; and made smaller again."""

from __future__ import annotations

import copy
import re
import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterator, Sequence
from random import Random

from fuzzing import values

_MOST_ELEMENTS = 120  # of a seed that is cut down before it is changed
_MOST_GROWN = 4000  # elements that more are not added to
_DEEP = re.compile(rb"@@deep:(\w+):(\d{1,4})@@")
_RAW = {
    b"@@comments@@": b"<!--" * 20000,
    b"@@entity@@": b"&xxe;",
    b"@@cdata@@": b"<![CDATA[<x>]]>",
    b"@@null@@": b"\x00",
    b"@@pi@@": b"<?x y?>",
    # what TinyXML takes, and what it does not
    b"@@ampersand@@": b"a=1&b=2 & c",
    b"@@bracket@@": b"<x y='a<b>&'/>",
    b"@@bare@@": b"<x y=1 z=a/>",
    b"@@slash@@": b"<x y=a/b/>",
    b"@@twice@@": b"<x y='1' y='2'/>",
    b"@@less@@": b"1 < 2",
    b"@@unclosed@@": b"<x y='1>",
    b"@@character@@": b"&#xZZ;&#0;&#65;",
    b"@@dashes@@": b"<!-- a -- b --->",
}
_ROOTS = (b"<x/>", b"<robot/>", b"<sdf version='1.6'/>", b"text", b"<!-- ", b"\xef\xbb\xbf", b"\n\n")  # before or behind the root
_BOMB = (
    b'<!DOCTYPE x [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;"><!ENTITY c "&b;&b;&b;&b;&b;&b;&b;&b;&b;&b;">'
    b'<!ENTITY xxe SYSTEM "file:///etc/passwd">]>'
)


class XmlMutator:
    """:param seeds: real documents. :param snippets: elements worth putting anywhere, in ``<in tag="parent">`` elements."""

    def __init__(self, seeds: Sequence[bytes], snippets: bytes = b"<snippets/>"):
        self._roots = [ET.fromstring(seed) for seed in seeds]
        self._snippets: dict[str, list[ET.Element]] = {}
        for holder in ET.fromstring(snippets):
            self._snippets.setdefault(holder.get("tag", ""), []).extend(holder)
        self._pool: dict[str, list[ET.Element]] = {}
        for root in self._roots:
            for element in root.iter():
                if isinstance(element.tag, str) and sum(1 for _ in element.iter()) < 40:
                    self._pool.setdefault(element.tag, []).append(element)
        self._tags = sorted(self._pool)
        self._changes: list[tuple[int, Callable[[Random, ET.Element], None]]] = [
            (10, self._number),
            (3, self._tokens),
            (2, self._text),
            (4, self._delete),
            (3, self._double),
            (3, self._graft),
            (3, self._snippet),
            (2, self._rename),
            (2, self._attribute),
            (2, self._move),
            (1, self._many),
            (1, self._raw),
            (2, self._name),
            (1, self._swap),
        ]

    def case(self, random: Random) -> bytes:
        root = self._seed(random)
        functions = [change for _, change in self._changes]
        weights = [weight for weight, _ in self._changes]
        for _ in range(random.choice((1, 1, 2, 2, 3, 4, 6, 10, 20))):
            random.choices(functions, weights)[0](random, root)
            if sum(1 for _ in root.iter()) > _MOST_GROWN:  # copies of copies of copies
                break
        data = ET.tostring(root, encoding="unicode").encode("utf-8", "surrogatepass")
        data = _DEEP.sub(lambda m: b"<%b>" % m[1] * int(m[2]) + b"</%b>" % m[1] * int(m[2]), data, count=3)
        for marker, raw in _RAW.items():
            data = data.replace(marker, raw, 3)
        if b"&xxe;" in data or random.random() < 0.003:
            data = _BOMB + data
        if random.random() < 0.02:
            data = data + random.choice(_ROOTS) if random.random() < 0.5 else random.choice(_ROOTS) + data
        if random.random() < 0.03:
            data = values.damaged(random, data, random.randint(1, 3))
        return data

    def _seed(self, random: Random) -> ET.Element:
        root = random.choice(self._roots)
        holder = root
        while len(holder) == 1 and len(holder[0]):  # <sdf><world>: what may be cut down lies inside
            holder = holder[0]
        if sum(1 for _ in root.iter()) <= _MOST_ELEMENTS and random.random() < 0.7:
            return copy.deepcopy(root)
        keep = values.chosen(random, list(holder), random.randint(1, 12))
        chain = []
        element = root
        while element is not holder:
            chain.append(element)
            element = element[0]
        small = _shell(holder)
        small.extend(copy.deepcopy(child) for child in keep)
        for element in reversed(chain):
            outer = _shell(element)
            outer.append(small)
            small = outer
        return small

    # ------------------------------------------------------------------------------------------ changes

    @staticmethod
    def _pick(random: Random, root: ET.Element) -> ET.Element:
        return random.choice(list(root.iter()))

    @staticmethod
    def _child(random: Random, root: ET.Element) -> tuple[ET.Element, int] | None:
        parents = [element for element in root.iter() if len(element)]
        if not parents:
            return None
        parent = random.choice(parents)
        return parent, random.randrange(len(parent))

    def _number(self, random: Random, root: ET.Element) -> None:
        places = [
            (element, key)
            for element in root.iter()
            for key in [None, *element.attrib]
            if values.NUMBER.search((element.text if key is None else element.get(key)) or "")
        ]
        if not places:
            return
        element, key = random.choice(places)
        if key is None:
            element.text = values.with_numbers_changed(random, element.text)
        else:
            element.set(key, values.with_numbers_changed(random, element.get(key)))

    def _tokens(self, random: Random, root: ET.Element) -> None:
        element = self._pick(random, root)
        if element.attrib and random.random() < 0.5:
            key = random.choice(sorted(element.attrib))
            element.set(key, values.with_tokens_changed(random, element.get(key)))
        elif (element.text or "").strip():
            element.text = values.with_tokens_changed(random, element.text)

    def _text(self, random: Random, root: ET.Element) -> None:
        element = self._pick(random, root)
        element.text = random.choice(
            (values.number_text(random), random.choice(values.NAMES), random.choice(values.URIS), random.choice(values.ODDITIES))
        )

    def _name(self, random: Random, root: ET.Element) -> None:
        """A name or a reference by name: another's, or none that is there."""
        keys = ("name", "link", "joint", "filename", "type")
        named = [(element, key) for element in root.iter() for key in keys if key in element.attrib]
        named += [(element, None) for element in root.iter() if element.tag in ("parent", "child", "uri", "type", "filename")]
        if not named:
            return
        element, key = random.choice(named)
        other, other_key = random.choice(named)
        value = random.choice(
            ((other.get(other_key) if other_key else other.text) or "", random.choice(values.NAMES), random.choice(values.URIS))
        )
        if key is None:
            element.text = value
        else:
            element.set(key, value)

    def _delete(self, random: Random, root: ET.Element) -> None:
        place = self._child(random, root)
        if place:
            del place[0][place[1]]

    def _double(self, random: Random, root: ET.Element) -> None:
        place = self._child(random, root)
        if place:
            place[0].insert(random.randint(0, len(place[0])), copy.deepcopy(place[0][place[1]]))

    def _graft(self, random: Random, root: ET.Element) -> None:
        """An element of some other file, into a parent that knows its tag or into any."""
        element = self._pick(random, root)
        tag = random.choice(self._tags)
        if len(element) and random.random() < 0.6:
            tag = random.choice([child.tag for child in element])
        if tag in self._pool:
            element.insert(random.randint(0, len(element)), copy.deepcopy(random.choice(self._pool[tag])))

    def _snippet(self, random: Random, root: ET.Element) -> None:
        parents = [element for element in root.iter() if element.tag in self._snippets]
        if parents:
            parent = random.choice(parents)
            parent.insert(random.randint(0, len(parent)), copy.deepcopy(random.choice(self._snippets[parent.tag])))

    def _rename(self, random: Random, root: ET.Element) -> None:
        self._pick(random, root).tag = random.choice(self._tags)

    def _attribute(self, random: Random, root: ET.Element) -> None:
        element = self._pick(random, root)
        if element.attrib and random.random() < 0.5:
            del element.attrib[random.choice(sorted(element.attrib))]
        elif element.attrib:
            key = random.choice(sorted(element.attrib))
            value = element.attrib.pop(key)
            element.set(random.choice(("name", "type", "value", "xyz", "rpy", "filename", "relative_to", key + "x")), value)
        else:
            element.set(random.choice(("name", "type", "relative_to", "delay", "version")), values.number_text(random))

    def _move(self, random: Random, root: ET.Element) -> None:
        place = self._child(random, root)
        if place:
            child = place[0][place[1]]
            del place[0][place[1]]
            target = self._pick(random, root)
            target.insert(random.randint(0, len(target)), child)

    def _swap(self, random: Random, root: ET.Element) -> None:
        a, b = self._pick(random, root), self._pick(random, root)
        a.text, b.text = b.text, a.text

    def _many(self, random: Random, root: ET.Element) -> None:
        """Many of one, by names of their own."""
        place = self._child(random, root)
        if not place:
            return
        parent, index = place
        count = min(random.choice((3, 10, 10, 60)), _MOST_GROWN // sum(1 for _ in parent[index].iter()) + 1)
        for i in range(count):
            clone = copy.deepcopy(parent[index])
            if "name" in clone.attrib and random.random() < 0.9:
                clone.set("name", f"{clone.get('name')}_{i}")
            parent.append(clone)

    def _raw(self, random: Random, root: ET.Element) -> None:
        """Put in only after the tree has been written."""
        element = self._pick(random, root)
        if random.random() < 0.4:
            deep = random.choice(("x", "model", "link", "a", element.tag if re.fullmatch(r"\w+", element.tag) else "x"))
            element.text = (element.text or "") + f"@@deep:{deep}:{random.choice((5, 50, 150, 1500))}@@"
        else:
            element.text = (element.text or "") + random.choice([marker.decode() for marker in _RAW])


def _shell(element: ET.Element) -> ET.Element:
    shell = ET.Element(element.tag, element.attrib)
    shell.text = element.text
    return shell


# ---------------------------------------------------------------------------------------------- smaller again


def smaller(case: bytes) -> Iterator[bytes]:
    """Without elements, the large first; without attributes and texts; plain lines and bytes where it is no XML."""
    try:
        root = ET.fromstring(case)
    except ET.ParseError:
        yield from smaller_bytes(case)
        return
    if _BOMB in case or len(case) > 2_000_000:
        yield from smaller_bytes(case)
        return
    sizes = [(sum(1 for _ in child.iter()), parent, child) for parent in root.iter() for child in parent]
    for _, parent, child in sorted(sizes, key=lambda entry: -entry[0]):
        index = list(parent).index(child)
        parent.remove(child)
        yield _written(root)
        parent.insert(index, child)
        if len(child):  # its children in its place
            parent[index : index + 1] = list(child)
            yield _written(root)
            parent[index : index + len(child)] = [child]
    for element in list(root.iter()):
        for key in list(element.attrib):
            value = element.attrib.pop(key)
            yield _written(root)
            element.set(key, value)
        for name in ("text", "tail"):
            value = getattr(element, name)
            if value and value.strip():
                setattr(element, name, None)
                yield _written(root)
                setattr(element, name, value)
            elif value:
                setattr(element, name, None)


def _written(root: ET.Element) -> bytes:
    try:
        return ET.tostring(root, encoding="unicode").encode()
    except (RecursionError, ValueError):
        return b""


def smaller_bytes(case: bytes) -> Iterator[bytes]:
    """Pieces cut out: lines while there are many, then bytes."""
    pieces = case.splitlines(keepends=True)
    if len(pieces) < 3:
        pieces = [case[i : i + 1] for i in range(len(case))] if len(case) < 4000 else [case[i : i + 256] for i in range(0, len(case), 256)]
    size = len(pieces) // 2
    while size >= 1:
        for start in range(0, len(pieces), size):
            yield b"".join(pieces[:start] + pieces[start + size :])
        size //= 2
