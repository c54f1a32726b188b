// Tests incremental builds with the real cookers: an unchanged source runs no cooker, and the reasons for
// changes are named.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "cook/tools/dependency_list.h"
#include "pipelines/command/inspect/verify.h"
#include "tests/support/sandbox.h"
#include "tests/support/small_sources.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <sys/stat.h>
#include <thread>

namespace hearth::test
{

namespace
{

namespace fs = std::filesystem;

const std::vector<std::string> kAll{"import", "textures", "texels", "clusters", "skinning", "link"};

class SecondCook : public ::testing::Test
{
protected:
    SecondCook()
    {
        writeObj(folder, "house");
        writeGltf(folder, "tree");
    }

    ProgramEnd hearth(const std::vector<std::string>& arguments, std::vector<std::string> environment = {})
    {
        std::vector<std::string> command{programs + "/hearth"};
        command.insert(command.end(), arguments.begin(), arguments.end());
        environment.insert(environment.begin(), "HEARTH_LOG=verbose"); // print a line for each cooker
        return folder.run(command, environment);
    }

    ProgramEnd cook(std::vector<std::string> arguments, const std::vector<std::string>& environment = {})
    {
        arguments.insert(arguments.begin(), "cook");
        return hearth(withoutLightCookers(std::move(arguments)), environment);
    }

    /// Return the cookers that ran, as "clusters house.obj", from the printed lines.
    static std::multiset<std::string> ran(const ProgramEnd& end)
    {
        EXPECT_EQ(end.exit_code, 0) << end.err;
        std::multiset<std::string> cookers;
        std::istringstream lines(end.err);
        for (std::string line; std::getline(lines, line);)
            for (const char* cooker : {"import", "textures", "texels", "clusters", "skinning", "neighbours",
                                       "visibility", "specular", "link"})
                if (line.starts_with(std::string(cooker) + " ") && line.find(" s ") != std::string::npos)
                    cookers.insert(std::string(cooker) + " " + line.substr(line.rfind(' ') + 1));
        return cookers;
    }

    static bool isUpToDate(const ProgramEnd& end)
    {
        return ran(end).empty() && end.err.find("up to date") != std::string::npos;
    }

    struct stat look(const std::string& name) const
    {
        struct stat info = {};
        ::stat((folder / name).c_str(), &info);
        return info;
    }

    /// True if the temporary folder of a killed cook exists.
    bool hasLeftovers() const
    {
        const std::vector<std::string> names = folder.list();
        return std::any_of(names.begin(), names.end(),
                           [](const std::string& name)
                           { return name.find(".hearth-") != std::string::npos; });
    }

    Sandbox folder;
    std::string programs = HEARTH_BIN;
};

} // namespace

TEST_F(SecondCook, runsNothingAndLeavesThePackAlone)
{
    EXPECT_EQ(ran(cook({"house.obj", "tree.gltf", "-o", "a.hearth"})).size(), 11u);
    const struct stat before = look("a.hearth");
    EXPECT_TRUE(isUpToDate(cook({"house.obj", "tree.gltf", "-o", "a.hearth"})));
    // touched, but not changed
    writeObj(folder, "house");
    EXPECT_TRUE(isUpToDate(cook({"house.obj", "tree.gltf", "-o", "a.hearth"})));
    const struct stat after = look("a.hearth");
    EXPECT_EQ(before.st_ino, after.st_ino);
    EXPECT_EQ(before.st_mtim.tv_nsec, after.st_mtim.tv_nsec);
    EXPECT_TRUE(command::verifyFile(folder / "a.hearth").ok());
}

TEST_F(SecondCook, withoutACacheRunsAllAndLeavesThePackAlone)
{
    const std::vector<std::string> arguments{"house.obj", "-o", "a.hearth", "--no-cache"};
    ran(cook(arguments));
    const struct stat before = look("a.hearth");
    EXPECT_EQ(ran(cook(arguments)).size(), kAll.size());
    EXPECT_EQ(look("a.hearth").st_ino, before.st_ino);
    writeObj(folder, "house", 3);
    ran(cook(arguments));
    EXPECT_NE(look("a.hearth").st_ino, before.st_ino);
}

TEST_F(SecondCook, runsWhatReadAChangedFileAndNoMore)
{
    ran(cook({"house.obj", "tree.gltf", "-o", "a.hearth"}));
    folder.write("house.tga", tgaImage(7));
    EXPECT_EQ(ran(cook({"house.obj", "tree.gltf", "-o", "a.hearth"})),
              (std::multiset<std::string>{"import house.obj", "textures house.obj", "texels house.obj",
                                          "clusters house.obj", "skinning house.obj", "link a.hearth"}));
    // a texture that was missing now exists
    folder.write("tree.tga", tgaImage(7));
    EXPECT_EQ(ran(cook({"house.obj", "tree.gltf", "-o", "a.hearth"})).count("import tree.gltf"), 1u);
    // back to the original state: nothing is cooked, but the pack is restored
    const std::string pack = folder.read("a.hearth");
    writeObj(folder, "house");
    const ProgramEnd back = cook({"house.obj", "tree.gltf", "-o", "a.hearth"});
    EXPECT_EQ(ran(back), std::multiset<std::string>{"link a.hearth"});
    EXPECT_NE(folder.read("a.hearth"), pack);
}

TEST_F(SecondCook, repeatsTheWarnings)
{
    const ProgramEnd first = cook({"tree.gltf", "-o", "a.hearth"});
    const ProgramEnd second = cook({"./tree.gltf", "-o", "a.hearth"});
    EXPECT_TRUE(isUpToDate(second)) << second.err;
    EXPECT_EQ(countOccurrences(first.err, "tree.gltf|/images/0: warning: "), 1u) << first.err;
    EXPECT_EQ(countOccurrences(second.err, "\n./tree.gltf|/images/0: warning: ") +
                  (second.err.starts_with("./tree.gltf|/images/0: warning: ") ? 1u : 0u),
              1u)
        << second.err;
}

TEST_F(SecondCook, foldsTheWarningsThatWereTold)
{
    const std::string warning = "tree.gltf|/images/0: warning: ";
    const std::string folded =
        "2 warnings of unchanged sources, as in the cook before: 1 W1302, 1 W1401; hearth cook -v lists "
        "them\n";
    const std::vector<std::string> arguments{"tree.gltf", "-o", "a.hearth"};
    const auto cookWith = [&](const std::vector<std::string>& words)
    {
        std::vector<std::string> all = arguments;
        all.insert(all.end(), words.begin(), words.end());
        return cook(all, {"HEARTH_LOG=normal"}).err;
    };
    const std::string first = cookWith({});
    EXPECT_EQ(countOccurrences(first, warning), 1u) << first;
    EXPECT_EQ(countOccurrences(
                  first, "\n2 warnings: 1 W1302 (an image is missing; a placeholder is drawn), 1 W1401 ("),
              1u)
        << first;
    for (int i = 0; i < 2; ++i)
    {
        const std::string again = cookWith({});
        EXPECT_EQ(countOccurrences(again, warning), 0u) << again;
        EXPECT_EQ(countOccurrences(again, folded), 1u) << again;
    }
    EXPECT_EQ(cookWith({"-q"}), "");
    EXPECT_EQ(countOccurrences(cookWith({"-v"}), warning), 1u);
    EXPECT_EQ(countOccurrences(cookWith({"--log-format", "json"}), "W1302"), 1u)
        << "a script sees it each time";
    EXPECT_EQ(countOccurrences(cookWith({"--warnings-as-errors"}), warning), 1u) << "why there is no pack";
    EXPECT_EQ(countOccurrences(cook({"tree.gltf", "-o", "b.hearth"}).err, warning), 1u)
        << "the cache has it, but no cook into this pack has reported it";
    // another source does not unfold the warning; a change of its own source prints it in full
    EXPECT_EQ(countOccurrences(cook({"house.obj", "tree.gltf", "-o", "a.hearth"}, {"HEARTH_LOG=normal"}).err,
                               folded),
              1u);
    writeGltf(folder, "tree", 0.5F);
    EXPECT_EQ(countOccurrences(cook({"house.obj", "tree.gltf", "-o", "a.hearth"}).err, warning), 1u);
}

TEST_F(SecondCook, anEditOfAnOutputHarmsNothing)
{
    ran(cook({"house.obj", "-o", "a.hearth"}));
    const std::string pack = folder.read("a.hearth");
    std::ofstream(folder / "a.hearth", std::ios::binary | std::ios::in) << "scribble";
    const ProgramEnd again = cook({"house.obj", "-o", "a.hearth", "--explain"});
    EXPECT_TRUE(ran(again).empty()) << again.err;
    EXPECT_NE(again.err.find("a.hearth: it was not what had been cooked"), std::string::npos) << again.err;
    EXPECT_EQ(folder.read("a.hearth"), pack);
}

TEST_F(SecondCook, anotherFolderTakesWhatTheCacheHas)
{
    ran(cook({"house.obj", "tree.gltf", "-o", "a.hearth"}));
    Sandbox checkout;
    writeObj(checkout, "house");
    writeGltf(checkout, "tree");
    const ProgramEnd end = checkout.run(
        withoutLightCookers({programs + "/hearth", "cook", "house.obj", "tree.gltf", "-o", "a.hearth"}),
        {"HEARTH_CACHE=dir:" + checkout / "own;" + folder.cacheSpec() + ",ro"});
    EXPECT_TRUE(ran(end).empty()) << end.err;
    EXPECT_EQ(checkout.read("a.hearth"), folder.read("a.hearth"));
    fs::remove(checkout / "a.hearth");
    const ProgramEnd own =
        checkout.run(withoutLightCookers({programs + "/hearth", "cook", "house.obj", "tree.gltf", "-o",
                                          "a.hearth", "--cache", "dir:" + checkout / "own"}));
    EXPECT_TRUE(ran(own).empty()) << "written through: " << own.err;
}

TEST_F(SecondCook, whyNamesTheCause)
{
    folder.write("house.toml", "[animation]\nerror = 0.001\n");
    const fs::path copies = folder / "bin";
    fs::create_directory(copies);
    for (const auto& program : fs::directory_iterator(HEARTH_BIN))
        if (program.path().filename().string().starts_with("hearth"))
            fs::copy(program.path(), copies / program.path().filename());
    programs = copies.string();
    std::vector<std::string> arguments{"house.obj", "tree.gltf", "-o", "a.hearth", "--profile", "house.toml"};
    ran(cook(arguments));
    const auto breakContents = [&](const std::function<void(const std::string&)>& change)
    {
        for (const std::string& path : folder.cacheContents())
            change(path);
        fs::remove(folder / "a.hearth");
    };

    struct Row
    {
        std::string cause; ///< reason that the next cook prints and records
        std::function<void()> change;
        bool is_known_before = true; ///< true if hearth why knows the reason before the cook
    };
    const std::vector<Row> rows{
        {"import     house.obj: house.obj: its content has changed", [&] { writeObj(folder, "house", 2); }},
        {"import     house.obj: house.tga: its content has changed",
         [&] { folder.write("house.tga", tgaImage(7)); }},
        {"import     tree.gltf: tree.bin: its content has changed", [&] { writeGltf(folder, "tree", 0.5F); }},
        {"import     tree.gltf: tree.tga: is there now", [&] { folder.write("tree.tga", tgaImage(7)); }},
        // only the next cook reads the file's new contents
        {"import     2 sources (house.obj, tree.gltf): parameter animation.error: 0.001 -> 0.002",
         [&] { folder.write("house.toml", "[animation]\nerror = 0.002\n"); }, false},
        {"import     2 sources (house.obj, tree.gltf): parameter animation.error 0.002: no longer given",
         [&] { arguments.resize(4); }, false},
        {"clusters   2 sources (house.obj, tree.gltf): parameter --visibility: new",
         [&]
         {
             arguments = {"house.obj", "tree.gltf", "-o", "a.hearth", "--visibility", "--visibility-quality",
                          "draft"};
         },
         false},
        {"visibility 2 sources (house.obj, tree.gltf): parameter --quality: draft -> default",
         [&] { arguments.back() = "default"; }, false},
        {"skinning   2 sources (house.obj, tree.gltf): hearth-skinning has changed",
         [&] { std::ofstream(copies / "hearth-skinning", std::ios::app) << "another build"; }},
        {"link       a.hearth: third.obj: source added",
         [&]
         {
             writeObj(folder, "third");
             arguments.insert(arguments.begin(), "third.obj");
         },
         false},
        {"link       a.hearth: the sources are in another order",
         [&] { std::swap(arguments[0], arguments[1]); }, false},
        {"link       a.hearth: house.obj: source removed", [&] { arguments.erase(arguments.begin()); },
         false},
        {"pack       %: it is not there", [&] { fs::remove(folder / "a.hearth"); }},
        {"pack       %: it is not what was cooked", [&] { folder.write("a.hearth", "damage"); }},
        {"import     2 sources (third.obj, tree.gltf): forced", [&] { arguments.push_back("--force"); },
         false},
        {"link       a.hearth: its result is not in the cache, or not whole",
         [&]
         {
             arguments.pop_back();
             breakContents([](const std::string& path) { fs::remove(path); });
         },
         false},
        {"link       a.hearth: its result is not in the cache, or not whole",
         [&]
         {
             breakContents(
                 [](const std::string& path)
                 {
                     fs::permissions(path, fs::perms::owner_all);
                     std::ofstream(path, std::ios::binary | std::ios::in) << "damage";
                 });
         },
         false},
        {"import     2 sources (third.obj, tree.gltf): its result is not in the cache",
         [&] { fs::remove_all(folder.cachePath() + "/ac"); }},
    };
    const std::string pack = fs::path(folder / "a.hearth").lexically_normal().string();
    for (const Row& row : rows)
    {
        std::string cause = row.cause;
        if (const size_t percent = cause.find('%'); percent != std::string::npos)
            cause.replace(percent, 1, pack);
        row.change();
        const std::string before = hearth({"why", "a.hearth"}).out;
        ASSERT_NE(before.find("would run now:\n"), std::string::npos);
        if (row.is_known_before)
        {
            EXPECT_NE(before.substr(before.find("would run now:")).find(cause), std::string::npos)
                << cause << "\n"
                << before;
        }
        const ProgramEnd end = cook(arguments);
        EXPECT_EQ(end.exit_code, 0) << cause << "\n" << end.err;
        const std::string after = hearth({"why", "a.hearth"}).out;
        // reasons of an earlier cook are in the past tense
        for (const auto& [now, then] : std::vector<std::pair<std::string, std::string>>{
                 {"it is not there", "it was not there"},
                 {"it is not what was cooked", "it was not what had been cooked"}})
            if (const size_t at = cause.find(now); at != std::string::npos)
                cause.replace(at, now.size(), then);
        EXPECT_NE(after.substr(0, after.find("would run now:")).find(cause), std::string::npos)
            << cause << "\n"
            << after;
        EXPECT_NE(after.find("nothing: it is up to date"), std::string::npos) << cause << "\n" << after;
    }
    const std::string of_source = hearth({"why", "tree.gltf"}).out;
    EXPECT_NE(of_source.find("tree.gltf"), std::string::npos);
    EXPECT_EQ(of_source.find("third.obj"), std::string::npos) << of_source;
    EXPECT_EQ(hearth({"why", "nobody.obj"}).exit_code, 2);
}

TEST_F(SecondCook, whatFailedIsTriedAgain)
{
    ran(cook({"house.obj", "tree.gltf", "-o", "a.hearth"}));
    const std::string pack = folder.read("a.hearth");
    folder.write("tree.bin", "short");
    writeObj(folder, "house", 3);
    const ProgramEnd end = cook({"tree.gltf", "house.obj", "-o", "a.hearth"});
    EXPECT_EQ(end.exit_code, 65);
    EXPECT_EQ(countOccurrences(end.err, ": error: "), 2u) << "at once, and again at the end: " << end.err;
    EXPECT_NE(end.err.find("a.hearth: not linked, because a dependency failed: 1 of 2 sources"),
              std::string::npos);
    EXPECT_EQ(countOccurrences(end.err, "clusters  "), 1u) << "the other source was cooked: " << end.err;
    EXPECT_EQ(folder.read("a.hearth"), pack);
    const std::string why = hearth({"why", "a.hearth"}).out;
    EXPECT_NE(why.find("import     tree.gltf (failed): tree.bin: its content has changed"), std::string::npos)
        << why;
    EXPECT_NE(why.find("link       a.hearth (left out: a dependency failed)"), std::string::npos) << why;
    EXPECT_NE(why.find("import     tree.gltf: it failed last time"), std::string::npos) << why;
    writeGltf(folder, "tree", 0.25F);
    const std::multiset<std::string> again = ran(cook({"tree.gltf", "house.obj", "-o", "a.hearth"}));
    EXPECT_EQ(again.size(), 6u) << "what was cooked is not cooked again";
    EXPECT_EQ(again.count("import house.obj"), 0u);
}

TEST_F(SecondCook, severalFailuresAreAllTold)
{
    folder.write("tree.bin", "short");
    const ProgramEnd end = cook({"tree.gltf", "missing.obj", "house.obj", "-o", "a.hearth"});
    EXPECT_EQ(end.exit_code, 1) << "65 and 66";
    EXPECT_EQ(countOccurrences(end.err.substr(end.err.find("all failures again:\n")), ": error: "), 2u)
        << end.err;
    EXPECT_NE(end.err.find("2 of 3 sources"), std::string::npos) << end.err;
    EXPECT_FALSE(folder.has("a.hearth"));
    EXPECT_EQ(countOccurrences(cook({"tree.gltf", "missing.obj", "-o", "a.hearth", "--fail-fast", "-j1"}).err,
                               ": error: "),
              1u);
}

TEST_F(SecondCook, aSkippedSourceIsBackOnceItIsMended)
{
    const std::vector<std::string> arguments{"tree.gltf", "house.obj", "-o", "a.hearth", "--bricks"};
    std::vector<std::string> skipping = arguments;
    skipping.insert(skipping.end(), {"--missing", "skip"});
    EXPECT_EQ(cook({"house.obj", "-o", "house.hearth", "--bricks", "--no-cache"}).exit_code, 0);
    EXPECT_EQ(cook({"tree.gltf", "house.obj", "-o", "clean.hearth", "--bricks", "--no-cache"}).exit_code, 0);

    folder.write("tree.bin", "short");
    EXPECT_EQ(cook(skipping).exit_code, 1);
    ASSERT_TRUE(folder.has("a.hearth"));
    const std::string without = folder.read("a.hearth");
    EXPECT_EQ(hearth({"diff", "a.hearth", "house.hearth"}).out.find("mesh"), std::string::npos)
        << "the rest is as if it had never been named";
    EXPECT_NE(without, folder.read("house.hearth")) << "the pack says what it lacks";
    EXPECT_EQ(cook(arguments).exit_code, 65);
    EXPECT_EQ(folder.read("a.hearth"), without) << "untouched by a cook without the option";

    writeGltf(folder, "tree");
    const ProgramEnd dry = cook({"tree.gltf", "house.obj", "-o", "a.hearth", "--bricks", "-n"});
    EXPECT_NE(dry.out.find("import     tree.gltf: "), std::string::npos) << dry.out;
    const ProgramEnd mended = cook(skipping);
    EXPECT_EQ(mended.exit_code, 0) << mended.err;
    EXPECT_EQ(ran(mended).count("import house.obj"), 0u) << mended.err;
    EXPECT_TRUE(folder.read("a.hearth") == folder.read("clean.hearth"));
    // damaged again: the pack without it comes from the cache
    folder.write("tree.bin", "short");
    EXPECT_EQ(cook(skipping).exit_code, 1);
    EXPECT_TRUE(folder.read("a.hearth") == without);
    EXPECT_NE(hearth({"why", "a.hearth"}).out.find("tree.gltf"), std::string::npos);
}

TEST_F(SecondCook, aDryRunWritesNothing)
{
    const std::vector<std::string> files = folder.list();
    const ProgramEnd end = cook({"house.obj", "-o", "a.hearth", "--dry-run"});
    EXPECT_EQ(end.exit_code, 0);
    EXPECT_NE(end.out.find("import     house.obj: never cooked into this pack before\n"), std::string::npos)
        << end.out;
    EXPECT_NE(end.out.find("6 of 6 cookers would run\n"), std::string::npos) << end.out;
    EXPECT_EQ(folder.list(), files);
    EXPECT_FALSE(fs::exists(folder.cachePath()));
    const ProgramEnd plan = cook({"house.obj", "-o", "a.hearth", "-n", "--format", "json"});
    EXPECT_EQ(Json::parse(plan.out).value()["actions"].size(), 6u);
}

TEST_F(SecondCook, aDryRunChecksWhetherAllIsCooked)
{
    std::vector<std::string> arguments{"house.obj", "-o", "a.hearth", "--dry-run", "--check"};
    const ProgramEnd before = cook(arguments);
    EXPECT_EQ(before.exit_code, 1);
    EXPECT_NE(before.out.find("6 of 6 cookers would run\n"), std::string::npos) << before.out;
    ran(cook({"house.obj", "-o", "a.hearth"}));
    EXPECT_EQ(cook(arguments).exit_code, 0);
    const std::string pack = folder.read("a.hearth");
    folder.write("a.hearth", "damaged");
    EXPECT_EQ(cook(arguments).exit_code, 1) << "the pack would be put in its place";
    folder.write("a.hearth", pack);
    writeObj(folder, "house", 3);
    EXPECT_EQ(cook(arguments).exit_code, 1);
    arguments.insert(arguments.end(), {"--format", "json"});
    const ProgramEnd json = cook(arguments);
    EXPECT_EQ(json.exit_code, 1);
    EXPECT_EQ(Json::parse(json.out).value()["actions"].size(), 6u);
    EXPECT_EQ(cook({"house.obj", "-o", "a.hearth", "--dry-run"}).exit_code, 0) << "not asked for";
    EXPECT_EQ(cook({"house.obj", "-o", "a.hearth", "--check"}).exit_code, 2) << "there is nothing to check";
}

TEST_F(SecondCook, aKilledCookIsTakenUpWhereItWas)
{
    ran(cook({"house.obj", "tree.gltf", "-o", "whole.hearth", "--no-cache"}));
    std::mt19937 random(7);
    for (int round = 0; round < 5; ++round)
    {
        fs::remove_all(folder.cachePath());
        const pid_t process = folder.start(withoutLightCookers({programs + "/hearth", "cook", "-j1",
                                                                "house.obj", "tree.gltf", "-o", "a.hearth"}),
                                           {"TMPDIR="});
        std::this_thread::sleep_for(std::chrono::milliseconds(random() % 300));
        ::kill(process, SIGKILL);
        folder.finish(process);
        if (folder.has("a.hearth"))
        {
            EXPECT_EQ(folder.read("a.hearth"), folder.read("whole.hearth"));
        }
        EXPECT_EQ(cook({"house.obj", "tree.gltf", "-o", "a.hearth"}, {"TMPDIR="}).exit_code, 0);
        EXPECT_EQ(folder.read("a.hearth"), folder.read("whole.hearth"));
        // a cooker that outlives its parent may write into a folder that is being removed: the next cook
        // removes it
        for (int tries = 0; tries < 20 && hasLeftovers(); ++tries)
        {
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
            cook({"-f", "house.obj", "-o", "other.hearth"}, {"TMPDIR="});
        }
        EXPECT_FALSE(hasLeftovers());
        EXPECT_NE(hearth({"cache", "verify"}).out.find(" contents, "), std::string::npos);
        EXPECT_EQ(hearth({"cache", "verify"}).exit_code, 0);
        fs::remove(folder / "a.hearth");
    }
}

TEST_F(SecondCook, aCacheThatCannotBeUsedOnlyWarns)
{
    folder.write("file", "not a folder");
    const ProgramEnd end = cook({"house.obj", "-o", "a.hearth", "--cache", "dir:file"});
    EXPECT_EQ(ran(end).size(), 6u);
    EXPECT_EQ(countOccurrences(end.err, "[W4100]"), 1u) << end.err;
    EXPECT_TRUE(command::verifyFile(folder / "a.hearth").ok());
    EXPECT_EQ(ran(cook({"house.obj", "-o", "a.hearth"}, {"HEARTH_CACHE=off"})).size(), 6u);
    const ProgramEnd nowhere = cook({"house.obj", "-o", "a.hearth", "--cache", "dir:nowhere,ro"});
    EXPECT_EQ(ran(nowhere).size(), 6u);
    EXPECT_EQ(countOccurrences(nowhere.err, "W4100"), 0u) << nowhere.err;
    EXPECT_FALSE(folder.has("nowhere"));
    EXPECT_EQ(cook({"house.obj", "-o", "a.hearth", "--cache", "ftp://host/x"}).exit_code, 2);
}

TEST_F(SecondCook, tellsWatchersWhatHappens)
{
    const auto readEvents = [&](const std::vector<std::string>& arguments)
    {
        cook(arguments);
        std::istringstream lines(folder.read("events"));
        std::vector<Json> events;
        for (std::string line; std::getline(lines, line);)
            events.push_back(Json::parse(line).value());
        return events;
    };
    const auto first = readEvents({"house.obj", "-o", "a.hearth", "--events", "events"});
    ASSERT_EQ(first.size(), 14u) << "a start and an end of six cookers, and of the cook";
    EXPECT_EQ(first.front()["schema"], "hearth.events/1");
    EXPECT_EQ(first.front()["actions"], 6);
    EXPECT_EQ(first[1]["event"], "start");
    EXPECT_EQ(first[1]["why"][0], "never cooked into this pack before");
    EXPECT_EQ(first[2]["state"], "cooked");
    EXPECT_GT(first[2]["bytes"].get<double>(), 0);
    EXPECT_EQ(first.back()["event"], "done");
    EXPECT_EQ(first.back()["exit"], 0);
    const auto second = readEvents({"house.obj", "-o", "a.hearth", "--events", "events"});
    ASSERT_EQ(second.size(), 8u);
    EXPECT_EQ(second[1]["state"], "kept");
    folder.write("tree.bin", "short");
    const auto failed = readEvents({"tree.gltf", "-o", "a.hearth", "--events", "events"});
    ASSERT_EQ(failed.size(), 5u);
    EXPECT_EQ(failed[2]["state"], "failed");
    EXPECT_EQ(failed[3]["event"], "error");
    EXPECT_EQ(failed.back()["exit"], 65);
    EXPECT_EQ(cook({"house.obj", "-o", "a.hearth", "--events", "nowhere/events"}).exit_code, 73);
}

TEST_F(SecondCook, reportsWhatWasKept)
{
    ran(cook({"house.obj", "-o", "a.hearth", "--report", "a.json"}));
    const ProgramEnd end = cook({"house.obj", "-o", "a.hearth", "--report", "b.json"});
    EXPECT_TRUE(isUpToDate(end)) << end.err;
    const auto report = Json::parse(folder.read("b.json")).value();
    EXPECT_EQ(report["totals"]["cached"], 1);
    EXPECT_EQ(report["totals"]["actions"]["cached"], 6);
    EXPECT_EQ(report["assets"][0]["state"], "cached");
    EXPECT_EQ(report["assets"][0]["key"].get<std::string>().size(), 64u);
    EXPECT_EQ(report["totals"]["cpu_s"], 0);
    EXPECT_TRUE(report["assets"][0]["stages"][0]["cached"].get<bool>());
    EXPECT_EQ(report["assets"][0]["clusters"],
              Json::parse(folder.read("a.json")).value()["assets"][0]["clusters"]);
    EXPECT_FALSE(report["assets"][0]["clusters"].is_null());
    // the texture that the material names
    EXPECT_EQ(report["assets"][0]["deps"].size(), 2u) << report["assets"][0]["deps"];
}

TEST_F(SecondCook, aReportRunsNothingAgain)
{
    ran(cook({"house.obj", "-o", "a.hearth"}));
    EXPECT_TRUE(isUpToDate(cook({"house.obj", "-o", "a.hearth", "--report", "a.json"})));
    const auto report = Json::parse(folder.read("a.json")).value();
    EXPECT_GT(report["assets"][0]["clusters"]["meshes"].size(), 0u);
    EXPECT_EQ(report["assets"][0]["textures"].size(), 1u);
}

TEST_F(SecondCook, tellsMakeOfAllThatItReads)
{
    const std::string real = fs::canonical(folder.path()).string() + "/";
    const std::string house = "a.hearth: \\\n  house.obj \\\n  ./tree.gltf \\\n  " + real +
                              "house.mtl \\\n  " + real + "house.tga \\\n  " + real + "tree.bin\n\n" + real +
                              "house.mtl:\n\n" + real + "house.tga:\n\n" + real + "tree.bin:\n";
    const std::vector<std::string> arguments{"house.obj", "./tree.gltf", "-o",
                                             "a.hearth",  "--depfile",   "a.d"};
    ran(cook(arguments));
    EXPECT_EQ(folder.read("a.d"), house);
    // the cached result has read the same files
    fs::remove(folder / "a.d");
    EXPECT_TRUE(isUpToDate(cook(arguments)));
    EXPECT_EQ(folder.read("a.d"), house);
    // the same without a cache
    fs::remove(folder / "a.d");
    ran(cook(arguments, {"HEARTH_CACHE=off"}));
    EXPECT_EQ(folder.read("a.d"), house);
    // a texture that was missing now exists
    folder.write("tree.tga", tgaImage(7));
    ran(cook(arguments));
    EXPECT_NE(folder.read("a.d").find(real + "tree.bin \\\n  " + real + "tree.tga\n"), std::string::npos)
        << folder.read("a.d");
}

TEST_F(SecondCook, aDepfileThatCannotBeIsAnError)
{
    const std::string source = folder.read("house.obj");
    EXPECT_EQ(cook({"house.obj", "-o", "a.hearth", "--depfile", "./house.obj"}).exit_code, 2);
    EXPECT_EQ(folder.read("house.obj"), source);
    EXPECT_EQ(cook({"house.obj", "-o", "a.hearth", "--depfile", "./a.hearth"}).exit_code, 2);
    EXPECT_EQ(cook({"house.obj", "-o", "a.hearth", "--depfile", "nowhere/a.d"}).exit_code, 73);
    EXPECT_EQ(cook({"house.obj", "-o", "a.hearth", "--depfile", "a.d", "--dry-run"}).exit_code, 2);
    EXPECT_FALSE(folder.has("a.hearth"));
    EXPECT_FALSE(folder.has("a.d"));
}

TEST_F(SecondCook, theImportListsAllThatItReads)
{
    const auto reads = [&](std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), programs + "/hearth-import");
        arguments.insert(arguments.end(), {"-o", "a.part", "--depfile", "a.d"});
        EXPECT_EQ(folder.run(arguments).exit_code, 0);
        std::map<std::string, bool> is_there;
        const tools::DependencyList list = tools::DependencyList::parse(folder.read("a.d")).value();
        for (const auto& [path, hash] : list.files())
            is_there[path.substr(path.rfind('/') + 1)] = hash.has_value();
        return is_there;
    };
    using Files = std::map<std::string, bool>;
    EXPECT_EQ(reads({"house.obj"}), (Files{{"house.obj", true}, {"house.mtl", true}, {"house.tga", true}}));
    EXPECT_EQ(reads({"tree.gltf"}), (Files{{"tree.gltf", true}, {"tree.bin", true}, {"tree.tga", false}}));
    folder.write("low.ply",
                 "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                 "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                 "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    folder.write("a.toml", "[animation]\nerror = 0.1\n");
    EXPECT_EQ(reads({"house.obj", "--lod", "1=low.ply", "--profile", "a.toml"}), (Files{{"house.obj", true},
                                                                                        {"house.mtl", true},
                                                                                        {"house.tga", true},
                                                                                        {"low.ply", true},
                                                                                        {"a.toml", true}}));
    fs::remove(folder / "house.mtl");
    EXPECT_EQ(reads({"house.obj"}), (Files{{"house.obj", true}, {"house.mtl", false}}));
    EXPECT_EQ(reads({"house.tga"}), (Files{{"house.tga", true}}));
}

} // namespace hearth::test
