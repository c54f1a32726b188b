// Tests the installed files: names, paths, and use by a program without CMake.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/consumer/installation.h"

#include <filesystem>
#include <regex>
#include <set>
#include <sstream>

namespace hearth::test
{

namespace
{

namespace fs = std::filesystem;

class Installed : public Installation
{
protected:
    /// Return the folder of the libraries, relative to the prefix.
    static std::string libraryFolder()
    {
        for (const auto& entry : fs::recursive_directory_iterator(folder() / "prefix"))
            if (entry.path().filename() == "libhearth.so")
                return fs::relative(entry.path().parent_path(), folder() / "prefix").string();
        return "libhearth.so is not installed";
    }

    /// Run pkg-config with the files of a folder of libraries.
    static std::string pkgConfig(const std::string& library_folder)
    {
        return "PKG_CONFIG_PATH=\"$PWD/" + library_folder + "/pkgconfig\" pkg-config ";
    }

    /// Compile the game's version.c as C99.
    static void compile(const std::string& program, const std::string& flags)
    {
        run("cc -std=c99 -Wall -Wextra -Wpedantic -Werror "
            "-Wno-missing-field-initializers " HEARTH_SOURCE_FOLDER "/tests/consumer/game/version.c -o " +
            program + " " + flags);
    }
};

class FolderOfAProject : public Installation
{
protected:
    static std::string commands(const std::string& arguments);
};

/// Return the functions that hearth.h declares.
std::set<std::string> declaredFunctions(const std::string& header)
{
    std::set<std::string> names;
    const std::regex declaration(R"(\nHEARTH_API [^;(]*?(hearth_\w+)\()");
    for (std::sregex_iterator at(header.begin(), header.end(), declaration), end; at != end; ++at)
        names.insert((*at)[1]);
    return names;
}

} // namespace

TEST_F(Installed, theLibraryShowsTheFunctionsOfItsHeaderAndNoOthers)
{
    const std::string library = "prefix/" + libraryFolder() + "/libhearth.so";
    std::set<std::string> names;
    std::istringstream symbols(
        run("nm -D --defined-only --format=posix --without-symbol-versions " + library));
    for (std::string name, rest; symbols >> name && std::getline(symbols, rest);)
        names.insert(name);
    names.erase("HEARTH_1"); // version node of the other symbols
    const std::set<std::string> declared = declaredFunctions(folder().read("prefix/include/hearth/hearth.h"));
    EXPECT_GT(declared.size(), 30u);
    EXPECT_EQ(names, declared);
    EXPECT_NE(run("readelf -d " + library).find("soname: [libhearth.so.1]"), std::string::npos);
}

TEST_F(Installed, nothingKnowsWhereItWasBuiltOrInstalled)
{
    for (const std::string& path :
         {std::string(HEARTH_BUILD_FOLDER), std::string(HEARTH_SOURCE_FOLDER), folder() / "first"})
    {
        const ProgramEnd found = shell("grep -rlF '" + path + "' prefix");
        EXPECT_EQ(found.exit_code, 1) << path << " is in " << found.out;
    }
    EXPECT_EQ(shell("for file in prefix/bin/* prefix/" + libraryFolder() +
                    "/*.so; do readelf -d $file | grep -E 'RPATH|RUNPATH'; done")
                  .out,
              "");
}

TEST_F(Installed, isFoundByPkgConfig)
{
    const std::string pkg_config = pkgConfig("prefix/" + libraryFolder());
    compile("version", "$(" + pkg_config + "--cflags --libs hearth)");
    EXPECT_EQ(run("LD_LIBRARY_PATH=\"$PWD/prefix/" + libraryFolder() + "\" ./version"), "1.8: ok\n");
    run(pkg_config + "--exists 'hearth >= 0.1, hearth < 1'");
    for (const char* path : {"prefix", "includedir", "libdir"})
        run("test -d $(" + pkg_config + "--variable=" + path + " hearth)");
}

TEST_F(Installed, isLinkedIntoAProgramByPkgConfig)
{
    // without a shared library the linker takes the archive
    fs::remove_all(folder() / "archives");
    run("cp -r prefix archives && rm archives/" + libraryFolder() + "/libhearth.so*");
    const std::string pkg_config = pkgConfig("archives/" + libraryFolder());
    compile("version_static", "$(" + pkg_config + "--static --cflags --libs hearth hearth-helpers)");
    EXPECT_EQ(run("./version_static"), "1.8: ok\n");
}

TEST_F(Installed, pkgConfigFindsTheHelpers)
{
    folder().write("helpers.c",
                   "#include <hearth_helpers.h>\n#include <stdio.h>\n"
                   "int main(void) { hearth_device* device; char why[256] = \"\";\n"
                   "return hearth_device_create(NULL, &device, why, sizeof(why)) != HEARTH_ERROR_USAGE; }\n");
    const std::string pkg_config = pkgConfig("prefix/" + libraryFolder());
    run("cc -std=c99 helpers.c -o helpers $(" + pkg_config + "--cflags --libs hearth-helpers)");
    run("LD_LIBRARY_PATH=\"$PWD/prefix/" + libraryFolder() + "\" ./helpers");
}

/// Return the commands that build a project with Hearth as a subfolder.
std::string FolderOfAProject::commands(const std::string& arguments)
{
    fs::remove_all(folder() / "outer-build");
    fs::create_directory(folder() / "outer");
    folder().write("outer/CMakeLists.txt",
                   "cmake_minimum_required(VERSION 3.25)\nproject(outer LANGUAGES C CXX)\n"
                   "add_subdirectory(" HEARTH_SOURCE_FOLDER " hearth)\n"
                   "add_executable(version " HEARTH_SOURCE_FOLDER "/tests/consumer/game/version.c)\n"
                   "target_link_libraries(version PRIVATE hearth::runtime)\n"
                   "hearth_add_assets(version SOURCES version.glb)\n");
    run(HEARTH_CMAKE " -S outer -B outer-build -G Ninja " + arguments);
    return run("ninja -C outer-build -t commands all");
}

TEST_F(FolderOfAProject, buildsLibrariesAndCookersOnly)
{
    const std::string text = commands("");
    EXPECT_NE(text.find("bin/hearth cook "), std::string::npos);
    EXPECT_NE(text.find("bin/hearth-visibility"), std::string::npos);
    EXPECT_NE(text.find("libhearth.so"), std::string::npos);
    for (const char* none :
         {"hearth-render", "hearth-view", "hearth-samples", "_test.cpp", "-Wundef -Werror"})
        EXPECT_EQ(text.find(none), std::string::npos) << none;
    EXPECT_FALSE(folder().has("outer-build/CTestTestfile.cmake"));
}

TEST_F(FolderOfAProject, cooksWithAnotherHearthWhereItBuildsNone)
{
    const std::string text = commands("-DHEARTH_BUILD_COOKERS=OFF -DHEARTH_PROGRAM=/elsewhere/hearth");
    EXPECT_NE(text.find("/elsewhere/hearth cook "), std::string::npos);
    EXPECT_NE(text.find("libhearth.so"), std::string::npos);
    EXPECT_EQ(text.find("hearth-visibility"), std::string::npos);
}

TEST_F(FolderOfAProject, pkgConfigFindsAFolderOfLibrariesInAFolder)
{
    (void)commands("-DHEARTH_BUILD_COOKERS=OFF -DHEARTH_PROGRAM=/elsewhere/hearth -DHEARTH_INSTALL=ON "
                   "-DCMAKE_INSTALL_LIBDIR=lib/some-machine");
    fs::create_directories(folder() / "moved/include/hearth");
    fs::create_directories(folder() / "moved/lib/some-machine/pkgconfig");
    fs::copy(folder() / "outer-build/hearth/hearth.pc", folder() / "moved/lib/some-machine/pkgconfig");
    const std::string pkg_config = "PKG_CONFIG_PATH=\"$PWD/moved/lib/some-machine/pkgconfig\" pkg-config ";
    // --define-prefix takes "moved/lib" for the prefix
    for (const char* prefix : {"", "--define-prefix "})
    {
        const std::string variable = pkg_config + prefix + "--variable=";
        EXPECT_EQ(run("realpath $(" + variable + "includedir hearth)"), run("realpath moved/include/hearth"));
        EXPECT_EQ(run("realpath $(" + variable + "libdir hearth)"), run("realpath moved/lib/some-machine"));
    }
}

} // namespace hearth::test
