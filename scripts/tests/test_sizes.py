"""scripts/sizes.py: what is too long is named, by file and line."""

from pathlib import Path

import sizes

CPP = """namespace
{
int small(int a)
{
  return a;
}
struct Kind
{
  int method() { return 0; }
};
}  // namespace

void Kind::large(int a,
                 int b) const
{
  %s
}

TEST_F(Clients, Ask) {
  %s
}
"""


def test_functions_of_cpp_have_their_lengths():
    text = CPP % ("\n  ".join(["a += b;"] * 60), "\n  ".join(["a();"] * 61))
    assert list(sizes.cpp_functions(text)) == [("small", 3, 4), ("Kind::large", 13, 64), ("TEST_F", 78, 63)]


def test_complaints_name_file_line_and_what_to_do(tmp_path):
    path = tmp_path / "long.py"
    path.write_text("class A:\n    def long(self):\n" + "        pass\n" * 60 + "\n\ndef short():\n" + "    pass\n" * 59 + "x = 1\n" * 380)
    assert list(sizes.complaints(path)) == [
        f"{path}: 504 lines; split it, the most is 500",
        f"{path}:2: long() has 61 lines; split it, the most is 60",
    ]
    page = tmp_path / "long.md"
    page.write_text("x\n" * 1000)
    assert list(sizes.complaints(page)) == []
    script = tmp_path / "node"
    script.write_text("#!/usr/bin/env python3\ndef long():\n" + "    pass\n" * 61)
    assert list(sizes.complaints(script)) == [f"{script}:2: long() has 62 lines; split it, the most is 60"]


def test_folders_of_too_many_modules_are_named():
    full = [Path("src/full") / f"m{i}.py" for i in range(26)]
    others = [Path("src/fair") / f"m{i}.py" for i in range(25)] + [Path("src/fair") / f"m{i}.cpp" for i in range(9)]
    assert list(sizes.full_folders(full + others)) == ["src/full: 26 modules; sort them into folders, the most is 25"]
