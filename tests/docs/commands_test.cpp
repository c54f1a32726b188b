// Runs every command of the documents: the blocks marked `sh`, in the order of the list below, in one folder
// that has the sources they name. The TOML block of docs/settings.md is the folder's hearth.toml.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/sandbox.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hearth::test
{

namespace
{

namespace fs = std::filesystem;

// Later documents use what earlier ones cook.
constexpr const char* kDocuments[] = {
    "README.md",        "docs/cooking.md",    "docs/baking.md",       "docs/global_illumination.md",
    "docs/settings.md", "docs/build_farm.md", "docs/runtime.md",      "docs/streaming.md",
    "docs/reports.md",  "docs/formats.md",    "docs/ARCHITECTURE.md", "docs/GLOSSARY.md",
    "docs/LICENCES.md", "docs/textures.md",   "docs/topology.md",     "docs/bindings.md",
    "docs/versions.md", "CONTRIBUTING.md"};

std::string readFile(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Return the lines of a document's blocks of one language.
std::vector<std::string> readBlocks(const std::string& document, const std::string& language)
{
    std::vector<std::string> lines;
    bool is_inside = false;
    std::ifstream file(std::string(HEARTH_SOURCE_DIR) + "/" + document);
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("```"))
            is_inside = line == "```" + language;
        else if (is_inside && !line.empty())
            lines.push_back(line);
    return lines;
}

/// Return a command with less to compute: small images of the large sample, few texels of baked light. What
/// commands give is the subject of other tests.
std::string makeCheap(std::string line)
{
    for (const auto& [found, added] :
         {std::pair{"hearth-render gallery.hearth", " --size 320x180 --samples 1"},
          {"hearth cook gallery.glb --receivers", " --set receivers.texels_per_metre=1"}})
        if (const size_t at = line.find(found); at != std::string::npos)
            line.insert(at + std::string_view(found).size(), added);
    constexpr std::string_view kFine = "receivers.texels_per_metre=32";
    if (const size_t at = line.find(kFine); at != std::string::npos)
        line.replace(at, kFine.size(), "receivers.texels_per_metre=4");
    return line;
}

/// Return the tool of ./dev that a line calls: "test" of "./dev test asan".
std::string devTool(const std::string& line)
{
    const size_t start = line.find(' ') + 1;
    return line.substr(start, line.find_first_of(" \n", start) - start);
}

class Documents : public ::testing::Test
{
protected:
    /// Run lines of bash, each shown before it runs; the first that fails ends them.
    ProgramEnd runLines(const std::vector<std::string>& lines)
    {
        std::string script = "set -ex\nexport PATH=" HEARTH_BIN ":$PATH HEARTH_CACHE=dir:cache\n";
        for (const std::string& line : lines)
            script += line + "\n";
        return sandbox_.run({"/bin/bash", "-c", script});
    }

    /// The sources that the documents name, small.
    void makeSources()
    {
        const ProgramEnd end = runLines({
            "hearth-samples character -o robot.glb --texture-size 64",
            "hearth-samples room -o house.glb --texture-size 64",
            "cp house.glb room.glb",
            "hearth-samples grass -o tree.glb --texture-size 64",
            "hearth-samples rock -o rock.glb --triangles 3000 --texture-size 64",
            "hearth-samples rock -o rock_low.glb --triangles 500 --texture-size 64",
            "hearth cook rock.glb -o rock.part.hearth --progress none",
            "hearth extract rock.part.hearth --mesh 0 --error 0 -o scan.ply",
            "mkdir -p props assets/props",
            "cp scan.ply props/rock_LOD0.ply",
            "hearth extract rock.part.hearth --mesh 0 --error 0.05 -o props/rock_LOD1.ply",
            "cp rock.glb assets/props/barrel.glb",
            "cp robot.glb assets",
        });
        ASSERT_EQ(end.exit_code, 0) << end.err;
        std::string sky = "#?RADIANCE\n\n-Y 8 +X 16\n"; // brighter from top to bottom
        for (int i = 0; i < 128; ++i)
            sky += {static_cast<char>(60 + i / 4), '\x50', '\x60', '\x80'};
        sandbox_.write("noon.hdr", sky);
        std::string settings;
        for (const std::string& line : readBlocks("docs/settings.md", "toml"))
            settings += line + "\n";
        sandbox_.write("hearth.toml", settings);
    }

    Sandbox sandbox_;
};

} // namespace

TEST_F(Documents, haveCommandsThatRun)
{
    ASSERT_NO_FATAL_FAILURE(makeSources());
    const std::string tools = readFile(std::string(HEARTH_SOURCE_DIR) + "/dev");
    size_t count = 0;
    for (const char* document : kDocuments)
    {
        std::vector<std::string> lines;
        for (std::string line : readBlocks(document, "sh"))
        {
            ++count;
            if (line.starts_with("./dev"))
            {
                EXPECT_THAT(tools, ::testing::HasSubstr("./dev " + devTool(line))) << document;
                continue;
            }
            // a window on a display of its own, that closes
            if (line.starts_with("hearth-view"))
                line = "xvfb-run -a " + line.substr(0, line.find('#')) + " --frames 2";
            lines.push_back(makeCheap(line));
        }
        const ProgramEnd end = runLines(lines);
        EXPECT_EQ(end.exit_code, 0) << document << ":\n" << end.out << end.err;
    }
    EXPECT_GT(count, 50u) << "the documents were not found";
}

TEST(Licences, areThoseOfTheBuiltPrograms)
{
    Sandbox sandbox;
    const ProgramEnd end = sandbox.run(
        {"/bin/bash", HEARTH_SOURCE_DIR "/docs/list_licences.sh", HEARTH_BIN, HEARTH_RUNTIME_LIBRARY});
    EXPECT_EQ(end.exit_code, 0) << end.err;
    EXPECT_THAT(readFile(HEARTH_SOURCE_DIR "/docs/LICENCES.md"), ::testing::HasSubstr(end.out));
    // what games link, and the program that everybody starts
    for (const char* name : {"`hearth`", "`libhearth`", "`hearth-import`", "`hearth-render`"})
    {
        const size_t row = end.out.find(std::string("| ") + name + " |");
        ASSERT_NE(row, std::string::npos) << name;
        EXPECT_THAT(end.out.substr(row, end.out.find('\n', row) - row), ::testing::EndsWith("| no |"));
    }
}

TEST(DocumentLists, nameEveryDocument)
{
    std::vector<std::string> documents(std::begin(kDocuments), std::end(kDocuments));
    for (const auto& entry : fs::directory_iterator(std::string(HEARTH_SOURCE_DIR) + "/docs"))
        if (entry.path().extension() == ".md")
            EXPECT_THAT(documents, ::testing::Contains("docs/" + entry.path().filename().string()));
}

TEST(DocumentLists, haveASectionForTheVersionOfTheApi)
{
    const std::string header = readFile(HEARTH_SOURCE_DIR "/runtime/c/hearth.h");
    const std::string define = "#define HEARTH_API_VERSION ";
    const size_t at = header.find(define);
    ASSERT_NE(at, std::string::npos);
    const unsigned long version = std::stoul(header.substr(at + define.size()), nullptr, 16);
    EXPECT_THAT(readFile(HEARTH_SOURCE_DIR "/docs/versions.md"),
                ::testing::HasSubstr("\n### " + std::to_string(version >> 16) + "." +
                                     std::to_string(version & 0xFFFFu) + "\n"));
}

TEST(DocumentLinks, leadToFilesAndSections)
{
    for (const auto& entry : fs::recursive_directory_iterator(HEARTH_SOURCE_DIR))
    {
        const fs::path relative = entry.path().lexically_relative(HEARTH_SOURCE_DIR);
        if (entry.path().extension() != ".md" || relative.begin()->string() == "build")
            continue;
        const std::string text = readFile(entry.path().string());
        for (size_t at = text.find("]("); at != std::string::npos; at = text.find("](", at + 1))
        {
            const std::string link = text.substr(at + 2, text.find(')', at) - at - 2);
            if (link.find("://") != std::string::npos || link.find(' ') != std::string::npos ||
                link.starts_with("#"))
                continue;
            const fs::path target = entry.path().parent_path() / link.substr(0, link.find('#'));
            EXPECT_TRUE(fs::exists(target)) << relative << ": " << link;
            if (link.find('#') == std::string::npos || !fs::exists(target))
                continue;
            // a section's anchor: lower case, blanks become hyphens, punctuation goes
            const std::string anchor = link.substr(link.find('#') + 1);
            bool is_found = false;
            std::ifstream file(target);
            for (std::string line; std::getline(file, line);)
                if (line.starts_with("#"))
                {
                    std::string slug;
                    for (const char c : line.substr(line.find(' ') + 1))
                        if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_')
                            slug += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
                        else if (c == ' ')
                            slug += '-';
                    is_found = is_found || slug == anchor;
                }
            EXPECT_TRUE(is_found) << relative << ": " << link;
        }
    }
}

} // namespace hearth::test
