"""find_package(gazebo) tells sources that it cannot serve apart."""

import os
import subprocess

import pytest

PROJECT = "cmake_minimum_required(VERSION 3.5)\nproject(plugins)\n{before}find_package(gazebo REQUIRED)\n{after}"


def configure(folder, before="", source="", file="src/plugin.cpp", after="add_library(p {file})\n"):
    """What CMake says, without its line breaks."""
    (folder / file).parent.mkdir()
    (folder / file).write_text(source)
    (folder / "CMakeLists.txt").write_text(PROJECT.format(before=before, after=after.format(file=file)))
    done = subprocess.run(["cmake", "-S", folder, "-B", folder / "build"], capture_output=True, text=True)
    return done.returncode, " ".join((done.stdout + done.stderr).split())


@pytest.mark.slow
def test_sources_for_gazebo_7_are_named_and_configure(tmp_path):
    for number, call in enumerate(("model->GetWorldPose()", "joint->GetAngle(0).Radian()", "world->GetPhysicsEngine()")):
        folder = tmp_path / str(number)
        folder.mkdir()
        code, text = configure(folder, source=f"#include <gazebo/gazebo.hh>\nvoid f() {{ x = {call}; }}\n")
        assert code == 0 and "src/plugin.cpp is written for Gazebo 7 or older" in text, text


@pytest.mark.slow
def test_they_are_found_in_any_folder_of_the_package_if_it_compiles_them(tmp_path):
    ways = {
        "named": ("add_library(p {file})", True),
        "globbed": ("file(GLOB all plugins/*.cc)\nadd_library(p SHARED ${{all}})", True),
        "asked": ("option(OLD OFF)\nif(OLD)\n  add_library(p {file})\nendif()", False),
    }
    for way, (after, found) in ways.items():
        (tmp_path / way).mkdir()
        code, text = configure(tmp_path / way, source="#include <gazebo/math/Helpers.hh>\n", file="plugins/plugin.cc", after=after)
        assert code == 0 and ("plugins/plugin.cc is written for Gazebo 7 or older" in text) == found, text


@pytest.mark.slow
def test_sources_that_know_both_or_are_new_are_not(tmp_path):
    for name, source in (
        ("both", "#if GAZEBO_MAJOR_VERSION < 8\nmodel->GetWorldPose();\n#endif\n"),
        ("other", "#include <matrix/math.hpp>\nmath::Quaternion q;\n"),
        ("new", "ignition::math::Vector3d v = model->WorldPose().Pos();\n"),
    ):
        (tmp_path / name).mkdir()
        code, text = configure(tmp_path / name, source=source)
        assert code == 0 and "Gazebo 7" not in text, text


def test_sources_for_ros_2_end_the_configuration_in_one_sentence(tmp_path):
    code, text = configure(tmp_path, before="set(ament_cmake_FOUND TRUE)\n")
    assert code != 0 and "plugins is written for ROS 2" in text, text


def test_plain_projects_install_plugins_models_and_worlds_where_they_are_found(tmp_path):
    """As the ArduPilot plugin does: each path is one folder, and models lie beside worlds."""
    prefix = os.path.realpath(os.environ["CMAKE_PREFIX_PATH"].split(":")[0])
    for folder in ("models", "worlds"):
        (tmp_path / folder).mkdir()
    code, text = configure(
        tmp_path,
        source="int made;\n",
        after="add_library(p SHARED {file})\n"
        "install(TARGETS p DESTINATION ${{GAZEBO_PLUGIN_PATH}})\n"
        "install(DIRECTORY models worlds DESTINATION ${{GAZEBO_MODEL_PATH}}/..)\n",
    )
    assert code == 0, text
    subprocess.run(["cmake", "--build", tmp_path / "build"], check=True, capture_output=True)
    subprocess.run(
        ["cmake", "--install", tmp_path / "build"], check=True, capture_output=True, env={**os.environ, "DESTDIR": str(tmp_path / "to")}
    )
    found = {
        os.path.relpath(os.path.join(folder, name), tmp_path / "to")
        for folder, folders, files in os.walk(tmp_path / "to")
        for name in (*folders, *files)
    }
    inside = prefix.lstrip("/")
    assert {f"{inside}/lib/libp.so", f"{inside}/share/gazebo-11/models", f"{inside}/share/gazebo-11/worlds"} <= found, sorted(found)


def test_protos_are_found_by_packages_that_look_for_a_folder_of_the_version(tmp_path):
    """As underwater vehicles and multicopters do it, to let their own messages import Gazebo's."""
    (tmp_path / "own.proto").write_text(
        'syntax = "proto2";\nimport "vector3d.proto";\nmessage Own { required gazebo.msgs.Vector3d at = 1; }\n'
    )
    (tmp_path / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.5)\nproject(plugins)\nfind_package(gazebo REQUIRED)\n"
        'foreach(folder ${GAZEBO_INCLUDE_DIRS})\n  if(folder MATCHES ".*gazebo-[0-9.]+$")\n'
        '    message(STATUS "found ${folder}/gazebo/msgs;")\n  endif()\nendforeach()\n'
    )
    done = subprocess.run(["cmake", "-S", tmp_path, "-B", tmp_path / "build"], capture_output=True, text=True)
    folder = done.stdout.partition("found ")[2].partition(";")[0]
    assert folder and os.path.exists(f"{folder}/vector3d.pb.h"), done.stdout + done.stderr
    subprocess.run(
        ["protoc", f"--proto_path={folder}/proto", f"--proto_path={tmp_path}", f"--cpp_out={tmp_path}", tmp_path / "own.proto"], check=True
    )
    assert '#include "vector3d.pb.h"' in (tmp_path / "own.pb.h").read_text()


@pytest.mark.slow
def test_who_names_gazebo_ros_or_gazebo_plugins_alone_links_what_those_of_noetic_bring(tmp_path):
    """A node with an action client, as many have it: upstream's gazebo_ros depends on tf, that on tf2_ros, that on actionlib."""
    (tmp_path / "node.cpp").write_text(
        "#include <actionlib/goal_id_generator.h>\n#include <tf/transform_datatypes.h>\n#include <tf2_ros/buffer.h>\n"
        "#include WANTED\nint main() { actionlib::GoalIDGenerator made; tf2_ros::Buffer buffer; made.generateID(); }\n"
    )
    for package, header in (
        ("gazebo_ros", "dynamic_reconfigure/server.h"),
        ("gazebo_plugins", "camera_info_manager/camera_info_manager.h"),
    ):
        project = tmp_path / package
        project.mkdir()
        (project / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.5)\nproject(plugins)\nset(CMAKE_CXX_STANDARD 17)\n"
            f"find_package(catkin REQUIRED COMPONENTS {package})\n"
            f"include_directories(${{catkin_INCLUDE_DIRS}})\nadd_executable(node ../node.cpp)\n"
            f"target_compile_definitions(node PRIVATE WANTED=<{header}>)\ntarget_link_libraries(node ${{catkin_LIBRARIES}})\n"
        )
        subprocess.run(["cmake", "-S", project, "-B", project / "build"], check=True, capture_output=True)
        made = subprocess.run(["cmake", "--build", project / "build"], capture_output=True, text=True)
        assert made.returncode == 0, made.stdout + made.stderr


PKG_CONFIG = """cmake_minimum_required(VERSION 3.5)
project(plugins)
include(FindPkgConfig)
if(PKG_CONFIG_FOUND)
  pkg_check_modules(GAZEBO gazebo)
  pkg_check_modules(SDF REQUIRED sdformat9)
endif()
include_directories(${GAZEBO_INCLUDE_DIRS} ${SDF_INCLUDE_DIRS})
link_directories(${GAZEBO_LIBRARY_DIRS})
add_library(plugin SHARED plugin.cc)
target_link_libraries(plugin ${GAZEBO_LIBRARIES} ${SDF_LIBRARIES} -Wl,--no-undefined)
message(STATUS "found ${GAZEBO_INCLUDE_DIRS}.")
"""
PLUGIN = """#include "vector2d.pb.h"
#include <gazebo/common/Plugin.hh>
#include <sdf/sdf.hh>
class Named : public gazebo::WorldPlugin
{
  public: void Load(gazebo::physics::WorldPtr, sdf::ElementPtr element) override {element->GetName();}
};
GZ_REGISTER_WORLD_PLUGIN(Named)
"""


@pytest.mark.slow
def test_pkg_config_finds_gazebo_and_sdformat(tmp_path):
    """As Gazebo's first tutorials and the map makers of courses ask for it."""
    (tmp_path / "CMakeLists.txt").write_text(PKG_CONFIG)
    (tmp_path / "plugin.cc").write_text(PLUGIN)
    for command in (
        ["cmake", "-S", tmp_path, "-B", tmp_path / "build", "-DCMAKE_CXX_STANDARD=17"],
        ["cmake", "--build", tmp_path / "build"],
    ):
        done = subprocess.run(command, capture_output=True, text=True, timeout=300)
        assert done.returncode == 0, done.stdout + done.stderr
        if "found" in done.stdout:
            folders = done.stdout.partition("found ")[2].partition(".\n")[0].split(";")
            assert any(folder.endswith("/gazebo-11") for folder in folders), folders  # sought by its name
