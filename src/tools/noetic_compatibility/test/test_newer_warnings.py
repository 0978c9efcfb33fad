"""Packages that say -Werror meet the warnings of compilers that are newer than Noetic's, GCC 9."""

import shutil

import pytest

pytestmark = pytest.mark.slow

# What each of these says since which GCC is in gcc.gnu.org/gcc-N/changes.html; GCC 9 says nothing with -Wall -Wextra.
NEWER = {
    "-Wrange-loop-construct, 11": "void f(const std::vector<std::string>& v, int& n) { for (const std::string s : v) n += s.size(); }",
    "-Wdeprecated-declarations, 12": "struct I : std::iterator<std::input_iterator_tag, int> {};",
    "-Winfinite-recursion, 12": "int f(int n) { return f(n + 1) + 1; }",
    "-Woverloaded-virtual, 13": "struct A { virtual void f(int) {} virtual ~A() = default; }; struct B : A { virtual void f(double) {} };",
    "-Wself-move, 13": "void f(std::string& s) { s = std::move(s); }",
}


@pytest.mark.parametrize("text", NEWER.values(), ids=NEWER)
def test_a_warning_that_noetics_compiler_does_not_know_is_no_error(package, text):
    source = f"#include <iterator>\n#include <string>\n#include <utility>\n#include <vector>\n{text}\n"
    ended = package("roscpp", source, "add_compile_options(-Wall -Wextra -Werror)\nset(CMAKE_CXX_STANDARD 17)\n")
    assert ended.returncode == 0, ended.stdout + ended.stderr


@pytest.mark.parametrize("text", ["int f(int a) { int unused = a; return 1; }", "int f(int a) { if (a) return 1; }"])
def test_a_warning_that_it_knows_is_one(package, text):
    ended = package("roscpp", text, "add_compile_options(-Wall -Wextra -Werror)\n")
    assert ended.returncode != 0 and "-Werror=" in ended.stdout + ended.stderr


@pytest.mark.skipif(shutil.which("cc") is None, reason="no C compiler")
def test_c_of_before_gcc_14_compiles(package, tmp_path):
    """A function that nobody declared, and a number as a pointer: warnings up to GCC 13, errors of GCC 14 without -fpermissive."""
    (tmp_path / "old.c").write_text("int f(void) { int* p = 3; return undeclared(p); }\n")
    ended = package("roscpp", "int p;", after="add_library(old STATIC old.c)\n")
    assert ended.returncode == 0, ended.stdout + ended.stderr
