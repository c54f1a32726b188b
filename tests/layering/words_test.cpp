// Comments begin with a verb or a name and fit the page, and words that were given up do not come back.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace hearth::test
{

namespace
{

namespace fs = std::filesystem;

constexpr size_t kColumns = 110;

/// Return the rules that a line breaks.
///
/// is_first  the line before it is no comment
std::vector<std::string> findFaults(const std::string& line, bool is_first)
{
    static const std::regex head(R"(\s*///?\s*(What|Of|Where|Those|Whose|Which|How|Whether|Who|Why)\b.*)");
    static const std::regex member(R"(.*///<\s*(What|Of|Where|Those|Whose|Which|How|Whether)\b.*)");
    // limits are kMax and kMin; the others have a term of the field in docs/GLOSSARY.md
    static const std::regex words(
        R"((^|.*\W)(k(Most|Least|Largest|Smallest)([A-Z]\w*)?|kPatience\w*|toldOf\w*|is_told|Crew|Kitchen|Patience|WholeFile|PrivateFolder|NumberRows|FolderLevel|SideWays|twin_of|CookMemory|[a-z]\w*Of(?=\())\b.*)");
    std::vector<std::string> faults;
    if (is_first && std::regex_match(line, head))
        faults.emplace_back("a comment begins with a relative or question word");
    if (std::regex_match(line, member))
        faults.emplace_back("the comment of a member begins with a relative or question word");
    if (std::regex_match(line, words))
        faults.emplace_back("a word that was given up");
    if (line.size() > kColumns && line.find("//") != std::string::npos)
        faults.emplace_back("a comment wider than 110 columns");
    return faults;
}

bool isSource(const fs::path& path)
{
    const std::string extension = path.extension().string();
    for (const char* known : {".h", ".hpp", ".cpp", ".c", ".glsl", ".comp", ".vert", ".frag"})
        if (extension == known)
            return true;
    return false;
}

} // namespace

TEST(Words, areThoseOfTheField)
{
    size_t count = 0;
    for (const char* folder : {"formats", "cook", "pipelines", "runtime", "sample_assets", "tests"})
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(HEARTH_SOURCE_DIR) / folder))
        {
            if (!isSource(entry.path()) || entry.path().filename() == "words_test.cpp")
                continue;
            ++count;
            std::ifstream file(entry.path());
            bool is_first = true;
            size_t number = 0;
            for (std::string line; std::getline(file, line);)
            {
                ++number;
                for (const std::string& fault : findFaults(line, is_first))
                    ADD_FAILURE() << entry.path().lexically_relative(HEARTH_SOURCE_DIR).generic_string()
                                  << ":" << number << ": " << fault << ": " << line;
                const size_t text = line.find_first_not_of(" \t");
                is_first = text == std::string::npos || line.compare(text, 2, "//") != 0;
            }
        }
    EXPECT_GT(count, 1000u) << "the sources were not found";
}

TEST(FindFaults, knowsTheRules)
{
    EXPECT_TRUE(findFaults("/// Return the largest error.", true).empty());
    EXPECT_TRUE(findFaults("/// where it is continued", false).empty());
    EXPECT_EQ(findFaults("// What becomes of one group.", true).size(), 1u);
    EXPECT_TRUE(findFaults("// What a line in the middle of a comment begins with.", false).empty());
    EXPECT_EQ(findFaults("    uint32_t count = 0; ///< Of all meshes", true).size(), 1u);
    EXPECT_EQ(findFaults("constexpr size_t kMostPairs = 4;", true).size(), 1u);
    EXPECT_TRUE(findFaults("constexpr size_t kMaxPairs = 4;", true).empty());
    EXPECT_EQ(findFaults("const size_t count = countOf(text);", true).size(), 1u);
    EXPECT_EQ(findFaults("// " + std::string(120, 'x'), true).size(), 1u);
}

} // namespace hearth::test
