// A budget of bytes for all textures of a pack, with the real programs: on one machine, from the cache and on
// a farm.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "cook/tools/png.h"
#include "tests/support/sandbox.h"

#include <gtest/gtest.h>
#include <random>
#include <string>
#include <vector>

namespace hearth::test
{

namespace
{

class TextureBudget : public ::testing::Test
{
protected:
    TextureBudget()
    {
        writeImage("smooth.png", 2);
        writeImage("rough.png", 120);
        folder.write("copy.png", folder.read("rough.png"));
    }

    /// Write an image of 64 x 64 texels with grain.
    void writeImage(const std::string& name, uint32_t grain)
    {
        constexpr uint32_t kSize = 64;
        std::mt19937 random(grain);
        std::vector<uint8_t> codes;
        for (uint32_t y = 0; y < kSize; ++y)
            for (uint32_t x = 0; x < kSize; ++x)
                for (uint32_t c = 0; c < 3; ++c)
                    codes.push_back(static_cast<uint8_t>(60 + (x + c * y) / 5 + random() % grain));
        const std::vector<std::byte> png = tools::encodePng(kSize, kSize, 3, codes);
        std::string text;
        for (const std::byte byte : png)
            text.push_back(static_cast<char>(byte));
        folder.write(name, text);
    }

    ProgramEnd hearth(const std::vector<std::string>& words)
    {
        std::vector<std::string> command{HEARTH_BIN "/hearth"};
        command.insert(command.end(), words.begin(), words.end());
        return folder.run(command, {"HEARTH_LOG=verbose"});
    }

    static std::vector<std::string> withSettings(std::vector<std::string> words, uint64_t budget)
    {
        words.insert(words.end(),
                     {"smooth.png", "rough.png", "copy.png", "--visibility", "off", "--bricks", "off",
                      "--texture-quality", "draft", "--set", "textures.families=[\"astc\"]"});
        if (budget != 0)
            words.insert(words.end(), {"--set", "textures.budget=" + std::to_string(budget)});
        return words;
    }

    ProgramEnd cook(uint64_t budget, const std::string& pack, const std::vector<std::string>& more = {})
    {
        std::vector<std::string> words = withSettings({"cook", "-o", pack}, budget);
        words.insert(words.end(), more.begin(), more.end());
        const ProgramEnd end = hearth(words);
        EXPECT_EQ(end.exit_code, 0) << end.err;
        return end;
    }

    Json totals(const std::string& pack)
    {
        return Json::parse(hearth({"inspect", pack, "--format", "json"}).out).value()["totals"];
    }

    /// Return how often a cooker ran, by the lines of a cook.
    static size_t countRuns(const ProgramEnd& end, const std::string& cooker)
    {
        size_t runs = 0;
        size_t begin = 0;
        while (begin < end.err.size())
        {
            const size_t stop = std::min(end.err.find('\n', begin), end.err.size());
            const std::string line = end.err.substr(begin, stop - begin);
            if (line.starts_with(cooker + " ") && line.find(" s ") != std::string::npos)
                ++runs;
            begin = stop + 1;
        }
        return runs;
    }

    Sandbox folder;
};

} // namespace

TEST_F(TextureBudget, isHeldAndSpentWhereMostIsLost)
{
    cook(0, "all.hearth");
    EXPECT_TRUE(totals("all.hearth")["texture_budget_bytes"].is_null());
    constexpr uint64_t kBudget = 5000;
    const ProgramEnd first = cook(kBudget, "a.hearth", {"--report", "report.json"});
    EXPECT_EQ(countRuns(first, "estimates"), 3u);
    EXPECT_EQ(countRuns(first, "budget"), 1u);
    EXPECT_EQ(totals("a.hearth")["texture_budget_bytes"].get<uint64_t>(), kBudget);
    const uint64_t bytes = totals("a.hearth")["texture_gpu_bytes"].get<uint64_t>();
    EXPECT_LE(bytes, kBudget);
    const Json report = Json::parse(folder.read("report.json")).value();
    const Json share = report["budget"]["share"];
    EXPECT_EQ(share["bytes"].get<uint64_t>(), bytes) << "the copy is in the pack once";
    EXPECT_EQ(share["textures"].get<uint64_t>(), 2u);
    EXPECT_TRUE(share["holds_budget"].get<bool>());
    const auto texture = [&](size_t asset) { return report["assets"][asset]["textures"][0]; };
    EXPECT_EQ(texture(0)["encoding"]["reason"], "budget");
    EXPECT_GT(texture(1)["bytes"].get<uint64_t>(), texture(0)["bytes"].get<uint64_t>());
    EXPECT_EQ(texture(1)["format"], texture(2)["format"]);

    const ProgramEnd second = cook(kBudget, "a.hearth");
    EXPECT_NE(second.err.find("up to date"), std::string::npos) << second.err;
    const ProgramEnd little_more = cook(kBudget + 1, "a.hearth");
    EXPECT_EQ(countRuns(little_more, "estimates"), 0u);
    EXPECT_EQ(countRuns(little_more, "budget"), 1u);
    EXPECT_EQ(countRuns(little_more, "texels"), 0u) << "formats are as before";
}

TEST_F(TextureBudget, givesTheSameBytesWithoutACacheAndOnAFarm)
{
    constexpr uint64_t kBudget = 5000;
    cook(kBudget, "a.hearth", {"--no-cache", "-j1"});
    const std::string pack = folder.read("a.hearth");
    EXPECT_EQ(hearth(withSettings({"plan", "-o", "plan.json", "--shards", "2"}, kBudget)).exit_code, 0);
    for (const char* shard : {"0/2", "1/2"})
        EXPECT_EQ(hearth({"run", "plan.json", "--shard", shard}).exit_code, 0);
    const ProgramEnd merged = hearth({"merge", "plan.json", "-o", "farm.hearth"});
    EXPECT_EQ(merged.exit_code, 0) << merged.err;
    EXPECT_TRUE(folder.read("farm.hearth") == pack);
}

TEST_F(TextureBudget, thatIsTooSmallIsWarnedOfOnce)
{
    const ProgramEnd end = cook(500, "a.hearth");
    EXPECT_EQ(countOccurrences(end.err, "[W1311]"), 1u) << end.err;
    EXPECT_NE(end.err.find("the budget is 500"), std::string::npos) << end.err;
    // rules for roles and names that there are none of
    const ProgramEnd rules = cook(0, "b.hearth",
                                  {"--set", "textures.role=[{role=\"normal\",target=2}]", "--set",
                                   "textures.image=[{name=\"smo*\",target=40},{name=\"x\",target=40}]"});
    EXPECT_EQ(countOccurrences(rules.err, "[W1515]"), 2u) << rules.err;
    EXPECT_NE(rules.err.find("textures.role[0]"), std::string::npos) << rules.err;
    EXPECT_NE(rules.err.find("there are color"), std::string::npos) << rules.err;
    EXPECT_NE(rules.err.find("textures.image[1]"), std::string::npos) << rules.err;
}

} // namespace hearth::test
