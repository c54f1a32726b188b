// Tests the page of a report in headless Chromium without a network.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "pipelines/report/write_report.h"
#include "tests/support/sandbox.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <sys/resource.h>

namespace hearth::report
{

namespace
{

using test::countOccurrences;

constexpr int kAssets = 4200;

Json makeMesh(int number)
{
    Json levels = Json::array();
    uint64_t triangles = 100 + static_cast<uint64_t>(number) * 37;
    for (double error = 0; triangles > 100; error = error * 2 + 1e-4, triangles /= 2)
        levels.push_back({{"clusters", triangles / 100},
                          {"triangles", triangles},
                          {"max_error", error},
                          {"mean_error", error / 2}});
    return {{"name", "mesh " + std::to_string(number)},
            {"source", {{"triangles", 100 + number * 37}, {"vertices", 50}}},
            {"clusters", 2 + number},
            {"bytes", {{"pages_stored", 900 + number * 300}}},
            {"levels", levels}};
}

Json makeStage(const char* stage, int number, bool ran)
{
    Json json{{"stage", stage}, {"state", ran ? "cooked" : "cached"}, {"seconds", 0.25}, {"bytes", 1000}};
    if (ran)
        json.update({{"start_s", number * 0.01},
                     {"lane", number % 2},
                     {"why", {"never cooked into this pack before"}}});
    return json;
}

/// Return the report of a cook of `assets` assets, one of which has failed.
Json makeReport(int assets)
{
    Json report{{"schema", "hearth.report/1"},
                {"tool", {{"name", "hearth"}, {"version", "0"}}},
                {"started", "2026-01-01T00:00:00Z"},
                {"status", "failed"},
                {"exit", 65},
                {"output", "out/village.hearth"},
                {"totals",
                 {{"assets", assets},
                  {"cooked", 10},
                  {"cached", assets - 11},
                  {"failed", 1},
                  {"wall_s", 42.5},
                  {"cpu_s", 80.0},
                  {"peak_rss", 1000000},
                  {"bytes_in", 5000000},
                  {"bytes_out", 0},
                  {"actions", {{"cooked", 40}, {"cached", 4 * assets - 40}}}}},
                {"failures",
                 {{{"subject", "asset7.glb"},
                   {"stage", "import"},
                   {"code", "E1103"},
                   {"severity", "error"},
                   {"text", "points nowhere"},
                   {"not_made", {{{"subject", "out/village.hearth"}, {"stage", "link"}}}}}}},
                {"assets", Json::array()}};
    for (int i = 0; i < assets; ++i)
    {
        Json asset{{"source", "props/<b>asset" + std::to_string(i) + ".glb"},
                   {"state", i % 400 == 7   ? "failed"
                             : i % 100 == 0 ? "cooked"
                                            : "cached"},
                   {"seconds", i % 100 == 0 ? 1.5 : 0.0},
                   {"bytes_in", 1000 + i},
                   {"sizes", {{"geometry", 900 + i * 300}, {"textures", 100}}},
                   {"stages", Json::array()},
                   {"clusters", {{"meshes", {makeMesh(i)}}}},
                   {"textures",
                    {{{"name", "bark"},
                      {"uses", {{{"material", "Old Oak"}, {"role", "metallicRoughness"}}}},
                      {"width", 64},
                      {"height", 64},
                      {"bytes_stored", 100},
                      {"error", {{"rms", 0.0}, {"psnr_db", nullptr}}}}}},
                   {"messages", Json::array()}};
        for (const char* stage : {"import", "textures", "clusters", "skinning"})
            asset["stages"].push_back(makeStage(stage, i, i % 100 == 0));
        report["assets"].push_back(asset);
    }
    return report;
}

/// Return the CPU seconds of all finished child processes and their descendants.
double childSeconds()
{
    struct rusage usage = {};
    ::getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& time)
    { return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6; };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

class Page : public ::testing::Test
{
protected:
    void SetUp() override
    {
#ifndef HEARTH_CHROMIUM
        GTEST_SKIP() << "there is no Chromium (Debian's package chromium) to open pages in";
#endif
    }

    /// Return the page's DOM after its script has run.
    std::string open(const std::string& name, int width = 1400)
    {
#ifdef HEARTH_CHROMIUM
        return folder
            .run({HEARTH_CHROMIUM, "--headless=new", "--no-sandbox", "--disable-gpu", "--no-first-run",
                  "--disable-background-networking", "--host-resolver-rules=MAP * ~NOTFOUND",
                  "--user-data-dir=" + (profile / "browser"),
                  "--window-size=" + std::to_string(width) + ",900", "--dump-dom",
                  "file://" + (folder / name)})
            .out;
#else
        return name + std::to_string(width);
#endif
    }

    /// Return a number that the script has stored at the root of the page; -1 if the script did not get
    /// there.
    static int getNumber(const std::string& dom, const std::string& attribute)
    {
        const size_t at = dom.find("data-" + attribute + "=\"");
        return at == std::string::npos ? -1 : std::stoi(dom.substr(at + attribute.size() + 7));
    }

    test::Sandbox folder;
    test::Sandbox profile; ///< profile folder of the browser
};

} // namespace

TEST_F(Page, showsRowsAreasCurvesAndTheFailureFirst)
{
    ASSERT_TRUE(writeReport(makeReport(40).dump(), folder / "page.html", "").ok());
    const std::string dom = open("page.html");
    ASSERT_GE(getNumber(dom, "ready"), 0) << dom.substr(0, 2000);
    EXPECT_EQ(getNumber(dom, "requests"), 0);
    EXPECT_GT(countOccurrences(dom, "role=\"row\""), 30u);
    EXPECT_GT(countOccurrences(dom, "class=\"cell\""), 40u) << "the treemap has a cell a mesh";
    EXPECT_GT(countOccurrences(dom, "class=\"curve\""), 30u);
    EXPECT_EQ(countOccurrences(dom, "class=\"curve on\""), 1u) << "that of the largest mesh";
    EXPECT_EQ(getNumber(dom, "bars"), 4) << "of the one asset that ran";
    EXPECT_LT(dom.find("points nowhere"), dom.find("id=\"assets\""));
    EXPECT_NE(dom.find("hearth explain E1103"), std::string::npos);
    EXPECT_EQ(dom.find("<b>asset"), std::string::npos) << "names are text";
}

TEST_F(Page, hasRoomForAllColumnsThatItShows)
{
    ASSERT_TRUE(writeReport(makeReport(40).dump(), folder / "page.html", "").ok());
    for (const int width : {1500, 1280, 800})
    {
        const std::string dom = open("page.html", width);
        EXPECT_EQ(getNumber(dom, "cut"), 0) << "tables of a page " << width << " pixels wide";
        EXPECT_NE(dom.find(">On the GPU<"), std::string::npos) << width;
        EXPECT_NE(dom.find(">Role<"), std::string::npos) << width;
    }
    const std::string dom = open("page.html", 800);
    EXPECT_NE(dom.find("No room for: Image, Asset, Size"), std::string::npos)
        << dom.substr(dom.find("No room for: "), 120);
}

TEST_F(Page, namesImagesByMaterialAndRole)
{
    ASSERT_TRUE(writeReport(makeReport(40).dump(), folder / "page.html", "").ok());
    const std::string dom = open("page.html");
    EXPECT_NE(dom.find(">Old Oak<"), std::string::npos);
    EXPECT_NE(dom.find(">metallicRoughness<"), std::string::npos);
}

TEST_F(Page, marksTexturesThatMissTheirTarget)
{
    Json report = makeReport(3);
    const auto encode = [&](size_t asset, double decibels, bool holds, const char* reason)
    {
        Json& texture = report["assets"][asset]["textures"][0];
        texture["bytes"] = 1000 - asset; // the first is shown
        texture["encoding"] = {{"role", "color"},
                               {"error", {{"psnr_db", decibels}}},
                               {"error_p999", {{"psnr_db", 9.0}}},
                               {"error_smooth", {{"psnr_db", nullptr}}},
                               {"target", {{"psnr_db", 39.0}}},
                               {"target_smooth", nullptr},
                               {"holds_target", holds},
                               {"reason", reason},
                               {"estimates", Json::array()}};
    };
    encode(0, 31.5, false, "target");
    encode(1, 39.5, true, "target");
    encode(2, 32.5, true, "budget");
    ASSERT_TRUE(writeReport(report.dump(), folder / "page.html", "").ok());
    const std::string dom = open("page.html");
    EXPECT_NE(dom.find("1 texture misses its target"), std::string::npos);
    EXPECT_NE(dom.find("31.5 dB (target 39.0 dB, missed)"), std::string::npos);
    EXPECT_EQ(countOccurrences(dom, ">39.0 dB ✗<"), 1u);
    EXPECT_EQ(countOccurrences(dom, ">39.0 dB<"), 2u) << "a budget asks for no error";
    EXPECT_EQ(getNumber(dom, "cut"), 0);
}

TEST_F(Page, saysWhatWasSlowAndWhichSettingHelps)
{
    ASSERT_TRUE(writeReport(makeReport(40).dump(), folder / "page.html", "").ok());
    const std::string dom = open("page.html");
    const size_t slow = dom.find("id=\"slow\"");
    ASSERT_NE(slow, std::string::npos);
    const std::string part = dom.substr(slow, dom.find("</section>", slow) - slow);
    EXPECT_EQ(countOccurrences(part, "<tr>"), 5u) << "the head, and the cookers that ran: " << part;
    EXPECT_NE(part.find("textures.max_size</code>: smaller textures are less to compress"), std::string::npos)
        << part;
    EXPECT_NE(part.find("no setting"), std::string::npos) << "of skinning: " << part;
}

TEST_F(Page, ofThousandsOfAssetsOpensAtOnce)
{
    const std::string path = folder / "page.html";
    ASSERT_TRUE(writeReport(makeReport(kAssets).dump(), path, "").ok());
    EXPECT_LT(folder.read("page.html").size(), 20u << 20);
    // CPU seconds in units of those that the browser needs for an empty page. The speed of the machine and
    // other load on it cancel then. Each page counts with the least of three openings.
    folder.write("empty.html", "<!doctype html><title>empty</title>");
    std::string dom;
    const auto measureSeconds = [&](const std::string& name)
    {
        double least = std::numeric_limits<double>::infinity();
        for (int i = 0; i < 3; ++i)
        {
            const double before = childSeconds();
            dom = open(name);
            least = std::min(least, childSeconds() - before);
        }
        return least;
    };
    const double start = measureSeconds("empty.html");
    const double seconds = measureSeconds("page.html") - start;
    ASSERT_GE(getNumber(dom, "ready"), 0);
    EXPECT_LT(seconds, 2 * start);
    EXPECT_EQ(getNumber(dom, "requests"), 0);
    EXPECT_LT(countOccurrences(dom, "role=\"row\""), 200u) << "only rows that are seen";
    EXPECT_EQ(getNumber(dom, "bars"), 4 * kAssets / 100);
    RecordProperty("milliseconds", static_cast<int>(seconds * 1000));
    RecordProperty("start_milliseconds", static_cast<int>(start * 1000));
    RecordProperty("wall_milliseconds", getNumber(dom, "ready"));
}

} // namespace hearth::report
