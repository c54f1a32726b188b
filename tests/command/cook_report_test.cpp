// Tests the reports that hearth cook writes, and hearth report.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "tests/support/cook_folder.h"
#include "tests/support/json_schema.h"

#include <filesystem>
#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

/// Return the first violation of the report's schema; empty if there is none.
std::string faultOfReport(const Json& report)
{
    return faultOfSchema(HEARTH_SCHEMAS "/hearth.report.1.json", report);
}

/// Slow script in place of hearth-render.
constexpr const char* kRender = R"(#!/bin/sh
output="${3%.jpg}"
while [ $# -gt 0 ]; do
  case "$1" in --views) views="$2" ;; --meshes) meshes="$2" ;; esac
  shift
done
sleep 0.6
for view in $(echo "$views" | tr , ' '); do
  if [ -z "$meshes" ]; then echo scene > "$output-$view.jpg"; fi
  number=0
  for mesh in $(echo "$meshes" | tr , ' '); do
    echo "$mesh" > "$output-$view-$(printf %04d $number).jpg"
    number=$((number + 1))
  done
done
)";

} // namespace

TEST_F(Cook, reportsWhatItDid)
{
    const ProgramEnd end = cook({"warning.gltf", "-o", "a.hearth", "--report", "report.json"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    const auto report = Json::parse(folder.read("report.json")).value();
    EXPECT_EQ(faultOfReport(report), "");
    EXPECT_EQ(report["schema"], "hearth.report/1");
    EXPECT_EQ(report["status"], "ok");
    EXPECT_EQ(report["failures"].size(), 0u);
    const auto& totals = report["totals"];
    EXPECT_EQ(totals["bytes_out"], folder.read("a.hearth").size());
    EXPECT_EQ(totals["bytes_in"], 100);
    EXPECT_EQ(totals["cooked"], 1);
    EXPECT_EQ(totals["actions"]["cooked"], 6);
    EXPECT_GT(totals["sizes"]["geometry"].get<double>(), 0);
    const auto& asset = report["assets"][0];
    EXPECT_EQ(asset["source"], "warning.gltf");
    EXPECT_EQ(asset["state"], "cooked");
    EXPECT_EQ(asset["stages"].size(), 5u);
    EXPECT_GE(asset["stages"][1]["start_s"].get<double>(), asset["stages"][0]["start_s"].get<double>());
    EXPECT_EQ(asset["clusters"]["meshes"][0]["name"], "strip");
    EXPECT_EQ(asset["clusters"]["totals"]["triangles"], 8);
    EXPECT_EQ(asset["textures"][0]["name"], "bark");
    EXPECT_EQ(asset["textures"][0]["format"], "astc-6x6-srgb") << "as it is in the pack";
    EXPECT_EQ(asset["textures"][0]["encoding"]["role"], "color");
    EXPECT_EQ(asset["sizes"]["geometry"], 70);
    EXPECT_EQ(asset["sizes"]["textures"], 30);
    EXPECT_EQ(asset["messages"].size(), 1u) << "the import's own list, not its lines as well";
    EXPECT_EQ(asset["messages"][0]["pointer"], "/extras");
    EXPECT_EQ(asset["dropped"][0], "extras");
    EXPECT_EQ(report["link"]["stage"], "link");
    EXPECT_EQ(report["dropped"][0]["source"], "warning.gltf");
    EXPECT_EQ(report["dropped"][0]["text"], "extras");
}

TEST_F(Cook, reportsRootCausesAndWhatDependsOnThem)
{
    EXPECT_EQ(cook({"good.gltf", "malformed.gltf", "-o", "a.hearth", "--report", "report.json"}).exit_code,
              65);
    const auto report = Json::parse(folder.read("report.json")).value();
    EXPECT_EQ(faultOfReport(report), "");
    EXPECT_EQ(report["status"], "failed");
    EXPECT_EQ(report["exit"], 65);
    EXPECT_EQ(report["assets"][0]["state"], "cooked");
    EXPECT_EQ(report["assets"][1]["state"], "failed");
    EXPECT_EQ(report["assets"][1]["stages"][1]["state"], "dependency failed");
    EXPECT_EQ(report["link"]["state"], "dependency failed");
    ASSERT_EQ(report["failures"].size(), 1u);
    const auto& failure = report["failures"][0];
    EXPECT_EQ(failure["code"], "E1101");
    EXPECT_EQ(failure["file"], "malformed.gltf");
    EXPECT_EQ(failure["pointer"], "/meshes/0");
    EXPECT_EQ(failure["text"], "is bad");
    EXPECT_EQ(failure["hint"], "mend it");
    EXPECT_EQ(failure["stage"], "import");
    EXPECT_EQ(failure["not_made"].size(), 5u) << "four cookers of the source, and the link";
    EXPECT_NE(report["error"].get<std::string>().find("E1101"), std::string::npos);
}

TEST_F(Cook, reportsWhereItDoesNotEvenBegin)
{
    EXPECT_EQ(cook({"good.gltf", "-o", ".", "--report", "report.json"}).exit_code, 73);
    const auto report = Json::parse(folder.read("report.json")).value();
    EXPECT_EQ(faultOfReport(report), "");
    EXPECT_EQ(report["assets"][0]["state"], "not cooked");
    ASSERT_EQ(report["failures"].size(), 1u);
    EXPECT_EQ(report["failures"][0]["code"], "E4000");
}

TEST_F(Cook, reportsACacheThatItCannotHave)
{
    EXPECT_EQ(
        cook({"good.gltf", "-o", "a.hearth", "--report", "report.json", "--cache", "http://"}).exit_code, 2);
    const auto report = Json::parse(folder.read("report.json")).value();
    EXPECT_EQ(faultOfReport(report), "");
    EXPECT_EQ(report["assets"][0]["state"], "not cooked");
    EXPECT_EQ(report["failures"][0]["code"], "E1000");
}

TEST_F(Cook, tellsThatImagesAreDrawnAndCountsTheirTime)
{
    programs.write("hearth-render", kRender, true);
    const ProgramEnd end =
        cook({"good.gltf", "-o", "a.hearth", "--report", "page.html", "--events", "events"});
    EXPECT_EQ(end.exit_code, 0) << end.err;
    // of the scene and of its mesh, four views each
    const size_t begun = end.err.find("drawing 8 images for the report\n");
    const size_t drawn = end.err.find("8 of 8  drawn for the report\n");
    const size_t cooked = end.err.find("cooked  ");
    ASSERT_NE(begun, std::string::npos) << end.err;
    ASSERT_NE(drawn, std::string::npos) << end.err;
    ASSERT_NE(cooked, std::string::npos) << end.err;
    EXPECT_LT(begun, drawn);
    EXPECT_LT(drawn, cooked) << "the total is the last line";
    EXPECT_GE(std::stod(end.err.substr(cooked + 8)), 1.2) << end.err;
    const std::string events = folder.read("events");
    EXPECT_GE(Json::parse(events.substr(events.find("{\"event\":\"done\""))).value()["seconds"].get<double>(),
              1.2);
    EXPECT_EQ(countOccurrences(folder.read("page.html"), "data:image/jpeg"), 8u);

    std::filesystem::remove(folder / "a.hearth");
    EXPECT_EQ(cook({"good.gltf", "-q", "-o", "a.hearth", "--report", "page.html"}).err, "");
}

TEST_F(Cook, writesReportsForWhoeverReadsThem)
{
    const ProgramEnd end = cook({"good.gltf", "malformed.gltf", "-o", "a.hearth", "--report", "r.json",
                                 "--report", "r.html", "--report", "r.xml", "--report", "r.csv"});
    EXPECT_EQ(end.exit_code, 65);
    EXPECT_EQ(folder.list(), (std::vector<std::string>{"r.csv", "r.html", "r.json", "r.xml"}));
    EXPECT_EQ(countOccurrences(folder.read("r.xml"), "<testcase "), 3u);
    EXPECT_EQ(countOccurrences(folder.read("r.xml"), "<failure "), 2u) << "the source, and the pack";
    EXPECT_EQ(countOccurrences(folder.read("r.csv"), "\r\n"), 3u);
    EXPECT_NE(folder.read("r.html").find("E1101"), std::string::npos);

    // the same values in the JSON
    const auto report = [&](std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), {programs / "hearth", "report"});
        return folder.run(arguments, {"TMPDIR="});
    };
    ASSERT_EQ(report({"r.json", "--html", "b.html", "--junit", "b.xml", "--csv", "b.csv"}).exit_code, 0);
    for (const char* ending : {".html", ".xml", ".csv"})
        EXPECT_EQ(folder.read(std::string("b") + ending), folder.read(std::string("r") + ending));
    folder.write("no.json", R"({"schema": "hearth.plan/1"})");
    EXPECT_EQ(report({"no.json", "--html", "c.html"}).exit_code, 65);
    EXPECT_EQ(report({"none.json", "--html", "c.html"}).exit_code, 66);
    EXPECT_EQ(report({"r.json", "--html", "c.txt"}).exit_code, 2);
    EXPECT_EQ(report({"r.json"}).exit_code, 2);
    EXPECT_FALSE(folder.has("c.html"));
}

TEST_F(Cook, aReportThatCannotBeWrittenIsAnError)
{
    const ProgramEnd end = cook({"a.gltf", "-o", "a.hearth", "--report", "nowhere/report.json"});
    EXPECT_EQ(end.exit_code, 73);
    EXPECT_NE(end.err.find("nowhere/report.json: error: "), std::string::npos);
}

} // namespace hearth::test
