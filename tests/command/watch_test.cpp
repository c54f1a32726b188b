// Tests hearth cook --watch with the real cookers: a change of any file that a cook reads starts a cook,
// nothing else does.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/sources/file_watch.h"
#include "tests/support/sandbox.h"
#include "tests/support/small_sources.h"

#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <gtest/gtest.h>
#include <thread>

namespace hearth::test
{

namespace
{

namespace fs = std::filesystem;

bool comes(const std::function<bool()>& condition)
{
    // long, for a busy machine; successful tests end earlier
    for (int i = 0; i < 3000; ++i, std::this_thread::sleep_for(std::chrono::milliseconds(20)))
        if (condition())
            return true;
    return false;
}

std::string getPath(const std::optional<command::FileWatch::Change>& change)
{
    return change ? change->path : "";
}

class Watch : public ::testing::Test
{
protected:
    Watch() { writeObj(folder, "house"); }
    ~Watch() override
    {
        if (process > 0)
            end(SIGKILL);
    }

    void start(std::vector<std::string> sources)
    {
        sources.insert(sources.begin(), {std::string(HEARTH_BIN) + "/hearth", "cook"});
        sources.insert(sources.end(), {"-o", "a.hearth", "--watch"});
        process = folder.start(sources);
    }

    ProgramEnd end(int signal)
    {
        ::kill(process, signal);
        const ProgramEnd ended = folder.finish(process);
        process = 0;
        return ended;
    }

    size_t cooks() const { return countOccurrences(folder.errSoFar(), "watching "); }
    bool waitsAfter(size_t cooks_before)
    {
        return comes([&] { return cooks() == cooks_before + 1; });
    }

    /// True once the command waits for a change; before that a signal may end it at once.
    bool waits()
    {
        return comes([&] { return folder.errSoFar().ends_with("Ctrl-C ends\n"); });
    }

    Sandbox folder;
    pid_t process = 0;
};

} // namespace

TEST_F(Watch, cooksWhatHasChangedAndNothingElse)
{
    folder.write("tree.txt", "is not read");
    start({"house.obj"});
    ASSERT_TRUE(waitsAfter(0)) << folder.errSoFar();
    const std::string first = folder.read("a.hearth");

    folder.write("house.tga", tgaImage(7));
    ASSERT_TRUE(waitsAfter(1)) << folder.errSoFar();
    EXPECT_NE(folder.errSoFar().find("house.tga has changed"), std::string::npos) << folder.errSoFar();
    const std::string second = folder.read("a.hearth");
    EXPECT_NE(second, first);

    // as editors save: another file replaces it
    folder.write("house.tga.new", tgaImage(8));
    fs::rename(folder / "house.tga.new", folder / "house.tga");
    ASSERT_TRUE(waitsAfter(2)) << folder.errSoFar();
    EXPECT_NE(folder.read("a.hearth"), second);

    folder.write("tree.txt", "is still not read");
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    EXPECT_EQ(cooks(), 3u) << folder.errSoFar();
    EXPECT_EQ(end(SIGINT).exit_code, 130);
}

TEST_F(Watch, aFailureWaitsForItsMend)
{
    writeGltf(folder, "tree");
    fs::remove(folder / "tree.bin");
    start({"house.obj", "tree.gltf"});
    ASSERT_TRUE(waitsAfter(0)) << folder.errSoFar();
    EXPECT_NE(folder.errSoFar().find("tree.gltf|/buffers/0/uri: error: "), std::string::npos)
        << folder.errSoFar();
    EXPECT_FALSE(folder.has("a.hearth"));
    writeGltf(folder, "tree");
    ASSERT_TRUE(comes([&] { return folder.has("a.hearth"); })) << folder.errSoFar();
    ASSERT_TRUE(waits()) << folder.errSoFar();
    // an image that was probed for but missing
    folder.write("tree.tga", tgaImage(7));
    EXPECT_TRUE(comes([&] { return countOccurrences(folder.errSoFar(), "tree.tga has changed") > 0; }))
        << folder.errSoFar();
    EXPECT_TRUE(waits()) << folder.errSoFar();
    EXPECT_EQ(end(SIGTERM).exit_code, 130);
}

TEST_F(Watch, aSkippedSourceIsTakenOnceItIsMended)
{
    writeGltf(folder, "tree");
    fs::remove(folder / "tree.bin");
    start({"house.obj", "tree.gltf", "--missing", "skip"});
    ASSERT_TRUE(waitsAfter(0)) << folder.errSoFar();
    ASSERT_TRUE(folder.has("a.hearth")) << folder.errSoFar();
    const std::string without = folder.read("a.hearth");
    writeGltf(folder, "tree");
    EXPECT_TRUE(comes([&] { return folder.read("a.hearth") != without; })) << folder.errSoFar();
    EXPECT_TRUE(waits()) << folder.errSoFar();
    EXPECT_EQ(end(SIGTERM).exit_code, 130);
}

TEST_F(Watch, settingsAreReadAnew)
{
    folder.write("hearth.toml", "[[rule]]\nmatch = '*'\ntextures.max_size = 2\n");
    start({"house.obj"});
    ASSERT_TRUE(waitsAfter(0)) << folder.errSoFar();
    const std::string first = folder.read("a.hearth");
    folder.write("hearth.toml", "[[rule]]\nmatch = '*'\ntextures.max_siz = 1\n");
    ASSERT_TRUE(waitsAfter(1)) << folder.errSoFar();
    EXPECT_NE(folder.errSoFar().find("did you mean 'max_size'"), std::string::npos) << folder.errSoFar();
    EXPECT_EQ(folder.read("a.hearth"), first);
    folder.write("hearth.toml", "[[rule]]\nmatch = '*'\ntextures.max_size = 1\n");
    ASSERT_TRUE(waitsAfter(2)) << folder.errSoFar();
    EXPECT_NE(folder.read("a.hearth"), first);
    EXPECT_EQ(end(SIGINT).exit_code, 130);
}

TEST_F(Watch, takesSourcesThatComeAndGo)
{
    fs::create_directories(folder / "village/old");
    for (const char* name : {"house.obj", "house.mtl", "house.tga"})
        fs::copy(folder / name, folder / (std::string("village/") + name));
    start({"village"});
    ASSERT_TRUE(waitsAfter(0)) << folder.errSoFar();
    const std::string first = folder.read("a.hearth");

    // the same in a folder that did not exist
    fs::create_directories(folder / "village/new/trees");
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    EXPECT_EQ(cooks(), 1u) << "folders are no sources: " << folder.errSoFar();
    writeObj(folder, "tree", 3);
    fs::rename(folder / "tree.obj", folder / "village/new/trees/tree.obj");
    ASSERT_TRUE(waitsAfter(1)) << folder.errSoFar();
    EXPECT_NE(folder.errSoFar().find("village/new/trees/tree.obj has changed"), std::string::npos)
        << folder.errSoFar();
    EXPECT_NE(folder.read("a.hearth"), first);

    folder.write("village/notes.txt", "are no source");
    fs::remove(folder / "village/new/trees/tree.obj");
    ASSERT_TRUE(waitsAfter(2)) << folder.errSoFar();
    EXPECT_EQ(folder.read("a.hearth"), first);
    EXPECT_EQ(end(SIGINT).exit_code, 130);
}

TEST_F(Watch, looksAtLevelsOfDetail)
{
    fs::create_directories(folder / "village");
    const auto put = [&](const std::string& name, double height)
    {
        writeObj(folder, "made", height);
        fs::rename(folder / "made.obj", folder / ("village/" + name));
    };
    put("house_LOD0.obj", 1);
    put("house_LOD1.obj", 2);
    start({"village"});
    ASSERT_TRUE(waitsAfter(0)) << folder.errSoFar();
    put("house_LOD1.obj", 3);
    ASSERT_TRUE(waitsAfter(1)) << folder.errSoFar();
    EXPECT_NE(folder.errSoFar().find("village/house_LOD1.obj has changed"), std::string::npos)
        << folder.errSoFar();
    put("house_LOD2.obj", 4);
    ASSERT_TRUE(waitsAfter(2)) << folder.errSoFar();
    EXPECT_NE(folder.errSoFar().find("village/house_LOD2.obj has changed"), std::string::npos)
        << folder.errSoFar();
    EXPECT_EQ(end(SIGINT).exit_code, 130);
}

TEST_F(Watch, aWrongCommandLineEnds)
{
    start({"house.obj", "house.obj", "--lod", "1=house.obj"});
    EXPECT_EQ(folder.finish(process).exit_code, 2);
    process = 0;
}

TEST(FileWatch, tellsOfFilesInFoldersThatComeLater)
{
    const Sandbox folder;
    auto files = command::FileWatch::create();
    ASSERT_TRUE(files.ok());
    const std::string path = folder / "textures/wood/oak.tga";
    ASSERT_TRUE(files->watch({path, path}, fs::file_time_type::clock::now()).ok());
    EXPECT_EQ(files->size(), 1u);
    fs::create_directories(folder / "textures/wood");
    EXPECT_EQ(getPath(files->wait()), path);
    ASSERT_TRUE(files->watch({path}, fs::file_time_type::clock::now()).ok());
    folder.write("textures/wood/oak.tga", "oak");
    EXPECT_EQ(getPath(files->wait()), path);
    fs::remove_all(folder / "textures");
    ASSERT_TRUE(files->watch({path}, fs::file_time_type::clock::now()).ok());
    EXPECT_EQ(getPath(files->wait()), path);
}

TEST(FileWatch, looksAtTimesInNewFoldersOnly)
{
    const Sandbox folder;
    folder.write("here.obj", "");
    auto files = command::FileWatch::create();
    ASSERT_TRUE(files.ok());
    const auto long_ago = fs::file_time_type::min();
    ASSERT_TRUE(files->watch({folder / "here.obj"}, long_ago).ok());
    EXPECT_EQ(getPath(files->wait()), folder / "here.obj") << "written before anybody looked";
    // a watched folder reports changes by itself
    ASSERT_TRUE(files->watch({folder / "here.obj", folder / "later.obj"}, long_ago).ok());
    folder.write("later.obj", "");
    EXPECT_EQ(getPath(files->wait()), folder / "later.obj");
}

TEST(FileWatch, tellsOfFilesThatComeIntoFolders)
{
    const Sandbox folder;
    folder.write("here.obj", "");
    auto files = command::FileWatch::create();
    ASSERT_TRUE(files.ok());
    const auto watch = [&]
    {
        return files->watch({folder / "here.obj"}, fs::file_time_type::clock::now(),
                            {folder.path(), folder / "later"});
    };
    ASSERT_TRUE(watch().ok());
    EXPECT_EQ(files->size(), 1u);
    folder.write("there.obj", "");
    const auto change = files->wait();
    EXPECT_EQ(getPath(change), folder.path());
    EXPECT_TRUE(change->is_in_folder);
    // a watched file has priority over other changes
    folder.write("elsewhere.obj", "");
    folder.write("here.obj", "another");
    EXPECT_EQ(getPath(files->wait()), folder / "here.obj");
    fs::create_directory(folder / "later");
    (void)files->wait();
    ASSERT_TRUE(watch().ok());
    folder.write("later/tree.obj", "");
    EXPECT_EQ(getPath(files->wait()), folder / "later");
}

TEST(FileWatch, tellsOfFilesBehindLinks)
{
    const Sandbox folder;
    fs::create_directory(folder / "store");
    folder.write("store/oak.tga", "oak");
    fs::create_symlink("store/oak.tga", folder / "oak.tga");
    auto files = command::FileWatch::create();
    ASSERT_TRUE(files.ok());
    ASSERT_TRUE(files->watch({folder / "oak.tga"}, fs::file_time_type::clock::now()).ok());
    folder.write("store/oak.tga", "another");
    EXPECT_EQ(getPath(files->wait()), fs::canonical(folder / "store/oak.tga").string());
}

} // namespace hearth::test
