"""Small packages in Noetic's style, configured and built with plain CMake against the sourced workspace."""

import ctypes
import os
import re
import subprocess
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parents[1]
LIST = HERE / "cmake/absent_packages.cmake"
pytestmark = pytest.mark.slow


def test_headers_of_packages_that_are_not_declared_are_found(package):
    """All of Noetic's headers lie in one folder: sources include what their package.xml does not name."""
    ended = package(
        "moveit_ros_planning_interface",
        """
        #include <moveit/move_group_interface/move_group_interface.h>
        #include <moveit_visual_tools/moveit_visual_tools.h>
        #include <controller_interface/controller.h>
    """,
    )
    assert ended.returncode == 0, ended.stdout


def test_a_copy_of_gazebo_ros_is_told_from_the_platforms(package, tmp_path):
    (tmp_path / "src").mkdir()
    (tmp_path / "src/gazebo_ros_api_plugin.cpp").write_text("")
    ended = package("roscpp")
    told = " ".join(ended.stderr.split())
    assert ended.returncode != 0 and f"{tmp_path} is a copy of gazebo_ros" in told, told
    assert f"touch {tmp_path}/CATKIN_IGNORE" in told, told  # rospack heeds it, too, and no skiplist


def test_headers_of_a_workspace_below_are_found_undeclared(package, tmp_path, monkeypatch):
    """Navigation is built from source here, beside /opt/ros/noetic's one folder: sources include what they do not declare."""
    (tmp_path / "below/devel/include/costs_msgs").mkdir(parents=True)
    (tmp_path / "below/devel/include/costs_msgs/Cost.h").write_text("")
    for folder in ("below/src/costs", "below/src/stack/plans"):
        headers = tmp_path / folder / "include" / folder.rpartition("/")[2]
        headers.mkdir(parents=True)
        (headers / "all.h").write_text("")
    (tmp_path / "below/devel/.catkin").write_text(str(tmp_path / "below/src"))
    monkeypatch.setenv("CMAKE_PREFIX_PATH", f"{tmp_path}/below/devel:{os.environ['CMAKE_PREFIX_PATH']}")
    ended = package("roscpp", "#include <costs/all.h>\n#include <plans/all.h>\n#include <costs_msgs/Cost.h>\n")
    assert ended.returncode == 0, ended.stdout + ended.stderr


@pytest.fixture
def program(tmp_path, package):
    """Function that links a program with ``libraries`` in a package of these components."""

    def link(components, source, libraries):
        package(components, "", build=False)
        (tmp_path / "p.cpp").write_text(source)
        with (tmp_path / "CMakeLists.txt").open("a") as lists:
            lists.write(f"add_executable(program p.cpp)\ntarget_link_libraries(program {libraries})\n")
        for command in (["cmake", "-S", tmp_path, "-B", tmp_path / "build", "-Wno-dev"], ["cmake", "--build", tmp_path / "build"]):
            ended = subprocess.run(command, capture_output=True, text=True, timeout=200)
            assert ended.returncode == 0, ended.stdout + ended.stderr

    return link


def test_libraries_of_packages_that_are_not_declared_are_found(program):
    """All of Noetic's libraries lie in one folder, too: packages link them by their bare names."""
    program("roscpp", "int main() {}\n", "-Wl,--no-as-needed controller_manager")


def test_rosbag_storage_hands_on_boosts_options(program):
    """slam_gmapping's replay links them so."""
    program(
        "roscpp rosbag_storage",
        "#include <boost/program_options.hpp>\nint main() { boost::program_options::variables_map map; }\n",
        "${catkin_LIBRARIES}",
    )


@pytest.fixture
def asked(tmp_path, package):
    """Function that builds one target of a package with a message Told, which includes its header and says no add_dependencies."""

    def build(lists, target):
        package("roscpp message_generation", "", build=False)
        (tmp_path / "msg").mkdir()
        (tmp_path / "msg/Told.msg").write_text("int32 number\n")
        (tmp_path / "p.cpp").write_text("#include <p/Told.h>\nint main() { return p::Told().number; }\n")
        text = (tmp_path / "CMakeLists.txt").read_text()
        (tmp_path / "CMakeLists.txt").write_text(
            text.replace("catkin_package()", "add_message_files(FILES Told.msg)\ngenerate_messages()\ncatkin_package()") + lists
        )
        for command in (
            ["cmake", "-S", tmp_path, "-B", tmp_path / "build", "-Wno-dev"],
            ["cmake", "--build", tmp_path / "build", "--target", target],
        ):
            ended = subprocess.run(command, capture_output=True, text=True, timeout=200)
            if ended.returncode:
                break
        return ended

    return build


@pytest.mark.parametrize("folder", ["", "nodes"])
def test_messages_come_before_the_nodes_that_include_them(asked, tmp_path, folder):
    lists = "add_executable(node ${PROJECT_SOURCE_DIR}/p.cpp)\n"
    if folder:
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "CMakeLists.txt").write_text(lists)
        lists = f"add_subdirectory({folder})\n"
    ended = asked(lists, "node")
    assert ended.returncode == 0, ended.stdout + ended.stderr


def test_a_program_that_messages_wait_for_does_not_wait_for_them(asked, tmp_path):
    (tmp_path / "first.cpp").write_text("int main() {}\n")
    ended = asked("add_executable(first first.cpp)\nadd_dependencies(p_generate_messages_cpp first)\n", "first")
    assert ended.returncode == 0, ended.stdout + ended.stderr


@pytest.mark.parametrize("standard", ["", "add_compile_options(-std=c++11)"])
def test_old_sources_build(package, standard):
    """Placeholders without namespace, an undeclared package's messages, headers under their names of before 2018."""
    ended = package(
        "roscpp std_msgs pluginlib",
        """
        #include <ros/ros.h>
        #include <angles/angles.h>
        #include <std_msgs/Float64.h>
        #include <control_msgs/JointControllerState.h>
        #include <pluginlib/class_list_macros.h>
        #include <class_loader/class_loader.h>
        struct Base { virtual ~Base() {} };
        struct Node : Base {
          void heard(const std_msgs::Float64::ConstPtr&, int) {}
          ros::Subscriber subscribe(ros::NodeHandle& nh) {
            return nh.subscribe<std_msgs::Float64>("x", 1, boost::bind(&Node::heard, this, _1, 3));
          }
          control_msgs::JointControllerState state;
          double turn = angles::normalize_angle(4.0);
        };
        PLUGINLIB_EXPORT_CLASS(Node, Base)
        """,
        standard,
    )
    assert ended.returncode == 0, ended.stdout + ended.stderr
    assert "global namespace is deprecated" not in ended.stdout + ended.stderr


@pytest.mark.parametrize("standard", ["14", "17", "20"])
def test_elements_of_vectors_of_bool_are_swapped(package, standard):
    """By std::swap, with its full name; libstdc++ 12 has it for calls without std:: only."""
    ended = package(
        "roscpp",
        """
        #include <vector>
        void f(std::vector<bool>& v, bool& b) {
          std::swap(v[0], v.back());
          std::swap(v[0], b);
          std::swap(b, v[0]);
          using std::swap;
          swap(v[0], v[1]);
        }
        """,
        f"add_compile_options(-std=c++{standard})",
    )
    assert ended.returncode == 0, ended.stdout + ended.stderr


@pytest.mark.parametrize("header", ["tree", "chain", "kinfam_io", "joint", "chainiksolverpos_lma"])
def test_kdl_calls_a_fixed_joint_as_noetics_does(program, tmp_path, header):
    program(
        "roscpp kdl_parser",
        f"""
        #include <kdl/{header}.hpp>
        #include <kdl_parser/kdl_parser.hpp>
        #include <iostream>
        int main() {{
          KDL::Chain chain;
          chain.addSegment(KDL::Segment());
          chain.addSegment(KDL::Segment(KDL::Joint("j", KDL::Joint::RotZ)));
          chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::None)));
          for (const auto& segment : chain.segments)
            std::cout << segment.getJoint().getTypeName() << " ";
          std::cout << chain.getNrOfJoints();
        }}
        """,
        "${catkin_LIBRARIES} orocos-kdl",
    )
    ended = subprocess.run([next((tmp_path / "build").rglob("program"))], capture_output=True, text=True, timeout=20)
    assert ended.stdout == "None RotZ None 1", ended.stdout + ended.stderr


@pytest.mark.parametrize(
    "minimum, before, after",
    [
        ("3.0.2", "add_compile_options(-std=c++11)", ""),
        ("3.22", "add_compile_options(-std=c++11)", ""),
        ("3.0.2", "add_definitions(-DX -std=c++11)", ""),
        ("3.22", "add_definitions(-std=c++11)", ""),
        ("3.0.2", 'set(CMAKE_CXX_FLAGS "${CMAKE_CXX_FLAGS} -std=c++0x -Wall")', ""),
        ("3.22", "set(CMAKE_CXX_STANDARD 11)\nset(CMAKE_CXX_EXTENSIONS OFF)", ""),
        ("3.0.2", "", "set_target_properties(p PROPERTIES CXX_STANDARD 14)"),
        ("3.22", "", "set_target_properties(p PROPERTIES COMPILE_FLAGS -std=c++14)"),
        ("3.0.2", "", "target_compile_options(p PRIVATE -std=gnu++14)"),
        ("3.22", "set(CMAKE_CXX_FLAGS -std=c++20)", ""),
        ("3.0.2", "add_definitions(-std=c++11)", "target_compile_options(p PRIVATE -std=c++20)"),
    ],
)
def test_an_older_standard_is_raised(tmp_path, minimum, before, after):
    """Where the system's headers need it; here this header does."""
    newer = "20" in before + after
    (tmp_path / "below").mkdir()
    (tmp_path / "below/p.cpp").write_text(
        f"#include <filesystem>\nstatic_assert(__cplusplus {'>' if newer else '=='} 201703L);\nstd::filesystem::path p;\n"
    )
    (tmp_path / "below/CMakeLists.txt").write_text(f"add_library(p SHARED p.cpp)\n{after}\n")
    (tmp_path / "CMakeLists.txt").write_text(
        f"cmake_minimum_required(VERSION {minimum})\nproject(p CXX)\ninclude({HERE}/cmake/old_standards.cmake)\n"
        f"noetic_raise_standard(17)\n{before}\nadd_subdirectory(below)\n"
    )
    build = tmp_path / "build"
    for command in (["cmake", "-S", tmp_path, "-B", build, "-Wno-dev"], ["cmake", "--build", build, "--verbose"]):
        ended = subprocess.run(command, capture_output=True, text=True, timeout=100)
        assert ended.returncode == 0, ended.stdout + ended.stderr


@pytest.mark.parametrize("asked", [(14, 17), (17, 14)])
def test_of_several_who_ask_for_a_standard_the_highest_counts(tmp_path, asked):
    """find_package(catkin) alone asks for PCL's, find_package(gazebo) for more, in whatever order."""
    (tmp_path / "p.cpp").write_text("static_assert(__cplusplus == 201703L);\n")
    (tmp_path / "CMakeLists.txt").write_text(
        f"cmake_minimum_required(VERSION 3.5)\nproject(p CXX)\ninclude({HERE}/cmake/old_standards.cmake)\n"
        f"add_compile_options(-std=c++11)\nnoetic_raise_standard({asked[0]})\nnoetic_raise_standard({asked[1]})\n"
        "add_library(p OBJECT p.cpp)\n"
    )
    build = tmp_path / "build"
    for command in (["cmake", "-S", tmp_path, "-B", build, "-Wno-dev"], ["cmake", "--build", build, "--verbose"]):
        ended = subprocess.run(command, capture_output=True, text=True, timeout=100)
        assert ended.returncode == 0, ended.stdout + ended.stderr


def test_a_standard_is_raised_no_further_than_needed(tmp_path):
    """One that suffices, or says more, is what it was."""
    (tmp_path / "p.cpp").write_text("static_assert(__cplusplus == WANTED);\n")
    (tmp_path / "CMakeLists.txt").write_text(f"""
        cmake_minimum_required(VERSION 3.5)
        project(p CXX)
        include({HERE}/cmake/old_standards.cmake)
        noetic_raise_standard(14)
        function(told standard wanted)
          add_library(told_${{standard}} OBJECT p.cpp)
          target_compile_options(told_${{standard}} PRIVATE -std=c++${{standard}} -DWANTED=${{wanted}}L)
        endfunction()
        told(11 201402)
        told(1y 201402)
        told(17 201703)
        add_definitions(-std=c++11)
        told(20 202002)
        add_library(newer OBJECT p.cpp)
        set_target_properties(newer PROPERTIES CXX_STANDARD 17 COMPILE_DEFINITIONS WANTED=201703L)
        """)
    build = tmp_path / "build"
    for command in (["cmake", "-S", tmp_path, "-B", build, "-Wno-dev"], ["cmake", "--build", build, "--verbose"]):
        ended = subprocess.run(command, capture_output=True, text=True, timeout=100)
        assert ended.returncode == 0, ended.stdout + ended.stderr


@pytest.mark.skipif(not Path("/usr/share/pcl_ros").is_dir(), reason="without pcl_ros")
@pytest.mark.parametrize(
    "header, cloud",
    [("pcl_ros/point_cloud.h", "pcl::PointCloud<pcl::PointXYZRGB>"), ("pcl_conversions/pcl_conversions.h", "pcl::PCLPointCloud2")],
)
def test_point_clouds_in_old_packages(package, header, cloud):
    """PCL of Debian 12 asks for C++14, Noetic's packages say C++11; its pointers are std's, Noetic's were boost's as those of roscpp."""
    ended = package(
        "pcl_ros roscpp",
        f"#include <{header}>\n#include <pcl/point_types.h>\ntypedef {cloud} Cloud;\n"
        + """
        #include <pcl/point_types.h>
        #include <ros/ros.h>
        ros::Publisher publisher;
        Cloud::Ptr last;
        void heard(const Cloud::ConstPtr& cloud) { publisher.publish(cloud); publisher.publish(*cloud); }
        void changes(Cloud::Ptr cloud) { last = cloud; publisher.publish(last); }
        void boosted(const boost::shared_ptr<const Cloud>& cloud) { publisher.publish(*cloud); }
        struct Node {
          void member(const Cloud::ConstPtr& cloud) { publisher.publish(cloud); }
          void constant(const Cloud::ConstPtr& cloud) const { publisher.publish(cloud); }
          void bound(const Cloud::ConstPtr& cloud, int) { publisher.publish(cloud); }
        } node;
        void subscribe(ros::NodeHandle& nh) {
          publisher = nh.advertise<Cloud>("y", 1);
          boost::function<void(const Cloud::ConstPtr&)> function = heard;
          static ros::Subscriber all[] = {
              nh.subscribe("x", 1, heard), nh.subscribe("x", 1, changes), nh.subscribe("x", 1, &Node::member, &node),
              nh.subscribe<Cloud>("x", 1, heard), nh.subscribe<Cloud>("x", 1, changes), nh.subscribe<Cloud>("x", 1, function),
              nh.subscribe<Cloud>("x", 1, boosted), nh.subscribe<Cloud>("x", 1, &Node::member, &node),
              nh.subscribe<Cloud>("x", 1, &Node::constant, &node, ros::TransportHints().tcpNoDelay()),
              nh.subscribe<Cloud>("x", 1, boost::bind(&Node::bound, &node, _1, 3)), nh.subscribe<Cloud>("x", 1, boost::bind(boosted, _1)),
              nh.subscribe<Cloud>("x", 1, [](const Cloud::ConstPtr& cloud) { publisher.publish(cloud); })};
        }
        """,
        "add_definitions(-std=c++11)",
    )
    assert ended.returncode == 0, ended.stdout + ended.stderr


@pytest.mark.skipif(not Path("/usr/share/pcl_ros").is_dir(), reason="without pcl_ros")
def test_boost_makes_the_pointers_of_pcl(package, tmp_path):
    ended = package(
        "pcl_ros roscpp",
        """
        #include <cstdio>
        #include <boost/make_shared.hpp>
        #include <pcl_ros/point_cloud.h>
        #include <pcl/PointIndices.h>
        #include <pcl/filters/extract_indices.h>
        #include <pcl/point_types.h>
        #include <pcl/search/kdtree.h>
        typedef pcl::PointXYZ Point;
        typedef pcl::PointCloud<Point> Cloud;
        struct Kept { boost::shared_ptr<Cloud> boosts = boost::make_shared<Cloud>(); Cloud::Ptr pcls = boost::make_shared<Cloud>(3, 1); };
        extern "C" int sizes() {
          Kept kept;
          pcl::PointIndices indices;
          indices.indices.push_back(1);
          pcl::ExtractIndices<Point> extract;
          extract.setInputCloud(kept.pcls);
          extract.setIndices(boost::make_shared<pcl::PointIndices>(indices));
          extract.setIndices(boost::make_shared<const pcl::PointIndices>(indices));
          auto result = boost::make_shared<Cloud>();
          extract.filter(*result);
          Cloud::ConstPtr constant = boost::make_shared<const Cloud>(*result);
          constant = result;
          kept.pcls = boost::make_shared<Cloud>(*result);
          pcl::search::KdTree<Point>::Ptr tree(boost::make_shared<pcl::search::KdTree<Point>>());
          tree->setInputCloud(result);
          const Cloud* object = result.get();
          result.reset();
          return constant.get() == object ? 10 * constant->size() + kept.pcls->size() : -1;
        }
        """,
        "add_definitions(-std=c++11)",
    )
    assert ended.returncode == 0, ended.stdout + ended.stderr
    assert ctypes.CDLL(str(next(tmp_path.rglob("libp.so")))).sizes() == 11


@pytest.mark.skipif(not Path("/usr/share/pcl_ros").is_dir(), reason="without pcl_ros")
def test_the_windows_of_pcl_are_found(package):
    ended = package(
        "pcl_ros roscpp",
        """
        #include <pcl/visualization/cloud_viewer.h>
        typedef pcl::PointCloud<pcl::PointXYZRGB> Cloud;
        void shows(const Cloud::ConstPtr& cloud, pcl::visualization::CloudViewer& window) { window.showCloud(cloud); }
        """,
    )
    assert ended.returncode == 0, ended.stdout + ended.stderr


@pytest.mark.parametrize("header", ["class_loader.h", "class_loader.hpp"])
def test_pluginlib_brings_what_noetics_brings(package, header):
    ended = package(
        "pluginlib roscpp",
        f"""
        #include <pluginlib/{header}>
        void told() {{ ROS_INFO("%s", ros::package::getPath("roscpp").c_str()); }}
        """,
    )
    assert ended.returncode == 0, ended.stdout + ended.stderr


def test_packages_of_catkin_make_find_the_old_headers_too(package, tmp_path):
    """catkin_make configures all packages in one run of CMake, with a find_package(catkin) of its own before theirs."""
    package("roscpp pluginlib", "#include <class_loader/class_loader.h>\n#include <pluginlib/class_list_macros.h>\n", build=False)
    workspace = tmp_path / "workspace"
    (workspace / "src/p").mkdir(parents=True)
    for file in ("package.xml", "CMakeLists.txt", "p.cpp"):
        (tmp_path / file).rename(workspace / "src/p" / file)
    (workspace / "src/CMakeLists.txt").symlink_to("/usr/share/catkin/cmake/toplevel.cmake")
    for step in (
        ["-S", workspace / "src", "-B", workspace / "build", "-Wno-dev", f"-DCATKIN_DEVEL_PREFIX={workspace}/devel"],
        ["--build", workspace / "build"],
    ):
        ended = subprocess.run(["cmake", *step], capture_output=True, text=True, timeout=280)
        assert ended.returncode == 0, ended.stdout + ended.stderr


def paragraph(ended):
    assert ended.returncode != 0 and ended.stderr.count("CMake Error") == 1, ended.stderr
    return " ".join(ended.stderr.split())


def test_an_absent_package_is_explained_in_one_paragraph(package):
    said = paragraph(package("roscpp amcl"))
    assert "The package 'amcl', which p asks for, is not here. It belongs to the navigation stack" in said
    assert "--continue-on-failure" in said and "Could not find a package configuration file" not in said
    assert "from source in your workspace (ros/executive_smach, branch noetic-devel)." in paragraph(package("smach"))


def test_opencv_is_no_package_of_catkin(package):
    assert "write find_package(OpenCV) beside it" in paragraph(package("roscpp opencv"))


def test_a_package_of_the_course_that_is_not_built_is_explained(package):
    said = paragraph(package("no_such_course_msgs"))
    assert "'no_such_course_msgs'" in said and "has to stand in this workspace's src folder" in said


def test_a_package_that_debian_has_is_named_with_its_debian_packages(package):
    if Path("/usr/share/octovis").exists() or not Path("/usr/share/python3-rosdep2/debian.yaml").exists():
        pytest.skip("octovis is installed, or rosdep's rules are not")
    assert "Debian has it: sudo apt install " in paragraph(package("octovis"))


def test_what_is_optional_stays_silent(package, tmp_path):
    (tmp_path / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.10)\nproject(q)\n"
        'find_package(catkin QUIET COMPONENTS amcl)\nmessage(STATUS "amcl ${amcl_FOUND}")\n'
    )
    ended = subprocess.run(["cmake", "-S", tmp_path, "-B", tmp_path / "b"], capture_output=True, text=True, timeout=200)
    assert ended.returncode == 0 and "amcl 0" in ended.stdout and ended.stderr == ""


def test_nothing_of_this_workspace_is_called_absent():
    """A new package here takes its name off the list."""
    absent = " ".join(re.findall(r'^_noetic_absent\("[^"]*"([^)]*)\)', LIST.read_text(), re.MULTILINE)).split()
    ours = {path.parent.name for path in HERE.parents[1].rglob("package.xml")}
    assert len(absent) > 40 and not set(absent) & ours
