// Tests the text and HTML forms of reports.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "formats/base/result.h"
#include "pipelines/graph/message.h"
#include "pipelines/report/base64.h"
#include "pipelines/report/page.h"
#include "pipelines/report/page_data.h"
#include "pipelines/report/tables.h"
#include "tests/support/sandbox.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

namespace hearth::report
{

using graph::Message;
using graph::parseMessage;

namespace
{

Json smallReport()
{
    return Json::parse(R"({
      "schema": "hearth.report/1", "tool": {"name": "hearth", "version": "0"}, "status": "failed", "exit": 65,
      "started": "2026-01-01T00:00:00Z", "output": "a.hearth",
      "totals": {"assets": 3, "wall_s": 2.5, "sizes": {"geometry": 100}},
      "failures": [{"subject": "b<&\".glb", "stage": "import", "code": "E1103", "severity": "error",
                    "text": "is <bad>", "pointer": "/meshes/0", "hint": "mend it", "not_made": []}],
      "messages": [{"code": "W1400", "severity": "warning", "text": "extras"}],
      "assets": [
        {"source": "a,1.glb", "state": "cooked", "seconds": 1.25, "bytes_in": 10, "sizes": {"geometry": 5, "textures": 7},
         "clusters": {"meshes": [{"name": "small", "clusters": 1, "source": {"triangles": 8, "vertices": 9},
                                  "bytes": {"pages_stored": 5}, "levels": []},
                                 {"name": "large", "clusters": 2, "source": {"triangles": 9, "vertices": 9},
                                  "bytes": {"pages_stored": 50}, "levels": [{"clusters": 1, "triangles": 9, "max_error": 0.5}]}],
                      "totals": {"triangles": 17}},
         "textures": [{"name": "bark", "width": 4, "uses": [{"material": "Oak", "role": "normal"}],
                       "encoding": {"role": "normal", "error": {"rms": 0.04, "degrees": 2.3}, "error_p999": {"degrees": 7.0},
                                    "error_smooth": {"degrees": 0.0}, "target": {"degrees": 3.0}, "target_smooth": null,
                                    "holds_target": true, "reason": "target",
                                    "estimates": [{"format": "astc-6x6-unorm", "bytes": 90, "error": {"degrees": 3.5},
                                                   "error_smooth": {"degrees": 0.0}}],
                                    "picture": {"x": 256, "y": 128, "error_x": 384, "width": 128, "height": 64,
                                                "brightest": {"degrees": 9.2}}}}],
         "messages": [{"code": "W1400", "severity": "warning", "text": "extras"}], "dropped": ["extras"]},
        {"source": "b<&\".glb", "state": "failed", "seconds": 0.5,
         "messages": [{"code": "E1103", "severity": "error", "text": "is <bad>", "pointer": "/meshes/0"}]},
        {"source": "=c.glb", "state": "not cooked",
         "clusters": {"meshes": [{"name": "middle", "clusters": 1, "bytes": {"pages_stored": 20}}]}}]})")
        .value();
}

} // namespace

TEST(ParseMessage, comesBackFromAllThatErrorsSay)
{
    for (const IssueInfo& info : allIssues())
    {
        const std::string line =
            formatMessage({info.issue, "a b.glb", "/meshes/0", "is [odd]: error: really"});
        const Message message = parseMessage(line);
        EXPECT_EQ(message.file, "a b.glb") << line;
        EXPECT_EQ(message.pointer, "/meshes/0") << line;
        EXPECT_EQ(message.severity, info.kind == IssueClass::warning ? "warning" : "error") << line;
        EXPECT_EQ(message.code.substr(1), std::to_string(static_cast<unsigned>(info.issue))) << line;
        EXPECT_EQ(message.text, "is [odd]: error: really") << line;
        EXPECT_EQ(message.hint, info.hint) << line;
    }
}

TEST(ParseMessage, takesWhatIsThere)
{
    EXPECT_EQ(parseMessage("noise of a library").text, "noise of a library");
    EXPECT_EQ(parseMessage("").text, "");
    const Message bare = parseMessage("error: no file at all");
    EXPECT_EQ(bare.severity, "error");
    EXPECT_EQ(bare.file, "");
    EXPECT_EQ(bare.text, "no file at all");
    EXPECT_EQ(parseMessage("a.glb: warning: half ] of [").text, "half ] of [");
}

TEST(Base64, isThatOfRfc4648)
{
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(JunitXml, hasACaseForEachAssetAndOneForThePack)
{
    const std::string xml = junitXml(smallReport().dump());
    EXPECT_NE(xml.find(R"(tests="4" failures="2" skipped="1" time="2.500")"), std::string::npos) << xml;
    EXPECT_NE(xml.find(R"(<testcase classname="hearth.cook" name="a,1.glb" time="1.250"/>)"),
              std::string::npos);
    EXPECT_NE(xml.find(R"(name="b&lt;&amp;&quot;.glb")"), std::string::npos) << xml;
    EXPECT_NE(xml.find(R"(message="/meshes/0: is &lt;bad&gt; [E1103]")"), std::string::npos) << xml;
    EXPECT_EQ(test::countOccurrences(xml, "<skipped/>"), 1u);
}

TEST(AssetTable, hasARowForEachAsset)
{
    const std::string csv = assetTable(smallReport().dump());
    EXPECT_EQ(test::countOccurrences(csv, "\r\n"), 4u);
    EXPECT_NE(csv.find("\r\n\"a,1.glb\",cooked,1.250,0.000,0,10,5,7,17,2,1,1,1,\r\n"), std::string::npos)
        << csv;
    EXPECT_NE(csv.find("\r\n\"b<&\"\".glb\",failed,"), std::string::npos) << csv;
    EXPECT_NE(csv.find("\r\n'=c.glb,"), std::string::npos) << "no formula";
}

TEST(ImportantMeshes, areTheLargestOfEachAssetBeforeAllOthers)
{
    std::vector<std::pair<uint32_t, std::string>> meshes;
    for (const PackMesh& mesh : importantMeshes(smallReport().dump()))
        meshes.emplace_back(mesh.index, mesh.name);
    EXPECT_EQ(meshes,
              (std::vector<std::pair<uint32_t, std::string>>{{1, "large"}, {2, "middle"}, {0, "small"}}));
}

TEST(PageData, isRowsOfWhatThePageShows)
{
    const Json data = Json::parse(pageData(smallReport().dump())).value();
    ASSERT_EQ(data["meshes"].size(), 3u);
    EXPECT_EQ(data["meshes"][1].dump(), R"(["large",0,9,9,50,2,0,[[1,9,0.5,0.0,0.0,0.0,0.0]]])");
    EXPECT_EQ(data["meshes"][2][1], 2) << "its asset";
    EXPECT_EQ(data["explain"]["E1103"]["summary"], issueInfo(Issue::gltf_reference).summary);
    EXPECT_TRUE(data["explain"].contains("W1400"));
    const Json& texture = data["textures"][0];
    EXPECT_EQ(texture[texture.size() - 2].dump(),
              R"(["normal",2.3,7.0,0.0,3.0,null,true,"target",)"
              R"([256,128,384,128,64],9.2,[["astc-6x6-unorm",90,3.5,0.0]]])");
    EXPECT_EQ(data["textures"][0].back().dump(), R"([["Oak","normal"]])");
}

TEST(PageData, listsProxiesWithTheLargerDistance)
{
    Json report = smallReport();
    EXPECT_EQ(Json::parse(pageData(report.dump())).value()["proxies"].size(), 0u);
    report["assets"][1]["proxies"] = Json::array();
    report["assets"][1]["proxies"].push_back({{"mesh", 0},
                                              {"name", "rock"},
                                              {"origin", "authored"},
                                              {"triangles", 12},
                                              {"vertices", 8},
                                              {"closed", true},
                                              {"distance", 0.25},
                                              {"mesh_distance", 0.5},
                                              {"bytes", 336}});
    EXPECT_EQ(Json::parse(pageData(report.dump())).value()["proxies"].dump(),
              R"([["rock",1,"authored",12,true,0.5,336]])");
}

TEST(PageData, saysWhichSettingsMakeEachCookerCheaper)
{
    const Json savings = Json::parse(pageData(smallReport().dump())).value()["savings"];
    const auto& visibility = savings["visibility"];
    const auto quality = std::find_if(visibility.begin(), visibility.end(),
                                      [](const Json& saving) { return saving[0] == "visibility.quality"; });
    ASSERT_NE(quality, visibility.end()) << savings;
    EXPECT_EQ((*quality)[1], "--visibility-quality");
    EXPECT_EQ((*quality)[2], "draft takes fewer rays");
    for (const auto& [cooker, list] : savings.items())
        EXPECT_TRUE(std::set<std::string>({"import", "textures", "texels", "clusters", "visibility", "probe",
                                           "bricks", "receivers", "reflections"})
                        .contains(cooker))
            << cooker << " runs in no cook";
    EXPECT_EQ(savings.size(), 9u) << savings;
}

TEST(ReportPage, cannotBeLeftByWhatIsInIt)
{
    Json report = smallReport();
    report["assets"][0]["source"] = "</script><script>alert(1)</script><!--@DATA@";
    const std::string page = reportPage(pageData(report.dump()), imagesData({}));
    EXPECT_EQ(test::countOccurrences(page, "<script"), 3u);
    EXPECT_EQ(test::countOccurrences(page, "</script"), 3u);
    // as text
    EXPECT_NE(page.find("\\u003c/script>\\u003cscript>alert(1)"), std::string::npos);
}

TEST(ReportPage, namesNothingThatIsElsewhere)
{
    const std::string page = reportPage(pageData(smallReport().dump()), imagesData({}));
    EXPECT_EQ(test::countOccurrences(page, "http://"), 1u) << "the namespace of SVG";
    EXPECT_EQ(test::countOccurrences(page, "https://"), 0u);
    EXPECT_EQ(test::countOccurrences(page, "@import"), 0u);
    EXPECT_EQ(test::countOccurrences(page, "url("), 0u);
    EXPECT_EQ(test::countOccurrences(page, "fetch("), 0u);
    EXPECT_EQ(test::countOccurrences(page, "default-src 'none'"), 1u);
}

} // namespace hearth::report
