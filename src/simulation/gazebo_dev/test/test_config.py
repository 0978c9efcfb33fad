"""find_package(gazebo) tells sources that it cannot serve apart."""
import subprocess

PROJECT = "cmake_minimum_required(VERSION 3.5)\nproject(plugins)\n{before}find_package(gazebo REQUIRED)\n"


def configure(folder, before="", source=""):
    """What CMake says, without its line breaks."""
    (folder / "src").mkdir()
    (folder / "src" / "plugin.cpp").write_text(source)
    (folder / "CMakeLists.txt").write_text(PROJECT.format(before=before))
    done = subprocess.run(["cmake", "-S", folder, "-B", folder / "build"], capture_output=True, text=True)
    return done.returncode, " ".join((done.stdout + done.stderr).split())


def test_sources_for_gazebo_7_are_named_and_configure(tmp_path):
    code, text = configure(tmp_path, source="void f() { pose = model->GetWorldPose(); }\n")
    assert code == 0 and "src/plugin.cpp is written for Gazebo 7 or older" in text, text


def test_sources_that_know_both_or_are_new_are_not(tmp_path):
    for name, source in (("both", "#if GAZEBO_MAJOR_VERSION < 8\nmodel->GetWorldPose();\n#endif\n"),
                         ("new", "ignition::math::Vector3d v = model->WorldPose().Pos();\n")):
        (tmp_path / name).mkdir()
        code, text = configure(tmp_path / name, source=source)
        assert code == 0 and "Gazebo 7" not in text, text


def test_sources_for_ros_2_end_the_configuration_in_one_sentence(tmp_path):
    code, text = configure(tmp_path, before="set(ament_cmake_FOUND TRUE)\n")
    assert code != 0 and "plugins is written for ROS 2" in text, text
