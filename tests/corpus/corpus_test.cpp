// Tests the corpus runner with misbehaving shell scripts in place of hearth and hearth-render.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/corpus/judge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace hearth::corpus
{

namespace
{

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

// In the scripts, $asset is the asset's path, $out the pack's, and the working folder is the box.
constexpr const char* kGoodCook = "echo pack > $out";
constexpr const char* kGoodReject = "echo \"$asset|/meshes/0: error: it is damaged [E1101]\" >&2; exit 65";
constexpr const char* kGoodInspect =
    R"(echo '{"schema": "hearth.inspect/1", "totals": {"source": {"triangles": 12, "vertices": 24, "faces": 6}},
              "scene": {"images": []}}')";
constexpr const char* kGoodRender = "echo image > $out";

const AssetClass& assetClass(std::string_view name)
{
    for (const AssetClass& known : kAssetClasses)
        if (known.name == name)
            return known;
    ADD_FAILURE() << "no class " << name;
    return kAssetClasses[0];
}

class CheckAsset : public testing::Test
{
protected:
    CheckAsset()
    {
        std::string folder = (fs::temp_directory_path() / "hearth-corpus-test-XXXXXX").string();
        root_ = ::mkdtemp(folder.data());
        for (const char* name : {"/bin", "/work", "/assets"})
            fs::create_directory(root_ + name);
        std::ofstream(root_ + "/assets/model.glb") << "a model";
        std::ofstream(root_ + "/secret") << "a secret";
        adoptOrphans();
    }
    ~CheckAsset() override { fs::remove_all(root_); }

    void writeScript(const std::string& name, const std::string& text) const
    {
        const std::string path = root_ + "/bin/" + name;
        std::ofstream(path) << "#!/bin/sh\nsecret=" << root_ << "/secret\n" << text << "\n";
        fs::permissions(path, fs::perms::owner_all);
    }

    Asset asset(std::string_view class_name) const
    {
        Asset asset;
        asset.file = "bad/model.glb";
        asset.path = root_ + "/assets/model.glb";
        asset.folder = root_ + "/assets";
        asset.expected = &assetClass(class_name);
        asset.limits = {20, uint64_t{1} << 30};
        asset.counts = {{"triangles", 12}, {"vertices", 24}};
        return asset;
    }

    /// Return the finding for an asset, with script `cook` in place of the cook.
    Finding check(const Asset& asset, const std::string& cook) const
    {
        writeScript("hearth", "case $1 in\ncook) asset=$2; out=$4; " + cook + " ;;\nverify) " + verify_ +
                                  " ;;\ninspect) " + inspect_ + " ;;\nextract) " + extract_ + " ;;\nesac");
        writeScript("hearth-import", import_);
        writeScript("hearth-wrap", wrap_);
        writeScript("hearth-render", "out=$3\n" + render_);
        return checkAsset(asset, programs(), root_ + "/work");
    }

    Programs programs() const
    {
        // the shell's own tools probe there for security modules
        const std::string bin = root_ + "/bin";
        return {.hearth = bin + "/hearth",
                .import = bin + "/hearth-import",
                .render = bin + "/hearth-render",
                .wrap = bin + "/hearth-wrap",
                .allowed = {bin, {"/proc/filesystems"}}};
    }

    /// Return the faults found for an asset of this class with this cook.
    std::vector<std::string> faults(const std::string& cook,
                                    std::string_view class_name = "must-not-crash") const
    {
        const Finding finding = check(asset(class_name), cook);
        EXPECT_EQ(finding.outcome == Outcome::broken, !finding.faults.empty());
        return finding.faults;
    }

    std::string root_;
    std::string verify_ = "true";
    std::string inspect_ = kGoodInspect;
    std::string render_ = kGoodRender;
    std::string extract_ = "true";
    std::string import_ = "true";
    std::string wrap_ = "true";
};

TEST_F(CheckAsset, acceptsASoundPackAndLeavesNothing)
{
    const Finding finding = check(asset("must-load"), kGoodCook);
    EXPECT_EQ(finding.outcome, Outcome::loads);
    EXPECT_THAT(finding.faults, IsEmpty());
    EXPECT_TRUE(fs::is_empty(root_ + "/work"));
}

TEST_F(CheckAsset, acceptsAClearError)
{
    const Finding finding = check(asset("must-reject"), kGoodReject);
    EXPECT_EQ(finding.outcome, Outcome::rejects);
    EXPECT_THAT(finding.faults, IsEmpty());
}

TEST_F(CheckAsset, asksForTheOutcomeOfTheClass)
{
    EXPECT_THAT(check(asset("must-reject"), kGoodCook).faults, ElementsAre("loads, and should be rejected"));
    EXPECT_THAT(check(asset("must-load"), kGoodReject).faults, ElementsAre("is rejected, and should load"));
    for (const char* either : {"must-not-crash", "load-or-clear-error", "load-or-clear-unsupported-error"})
    {
        EXPECT_THAT(check(asset(either), kGoodCook).faults, IsEmpty()) << either;
        EXPECT_THAT(check(asset(either), kGoodReject).faults, IsEmpty()) << either;
    }
}

TEST_F(CheckAsset, reportsACrashAndAnInternalError)
{
    EXPECT_THAT(faults("kill -SEGV $$"), ElementsAre(HasSubstr("hearth cook is ended by signal 11")));
    EXPECT_THAT(faults("echo \"$asset: error: a defect\" >&2; exit 70"),
                ElementsAre("hearth cook exits with 70"));
}

TEST_F(CheckAsset, endsAHangWithAllItsProcesses)
{
    Asset impatient = asset("must-not-crash");
    impatient.limits.seconds = 0.3;
    const Finding finding = check(impatient, "(sleep 30; echo late > $secret) & sleep 30; wait");
    EXPECT_THAT(finding.faults, Contains("hearth cook runs longer than 0.3 s"));
    EXPECT_LT(finding.cook_seconds, 5);
}

TEST_F(CheckAsset, reportsProcessesThatOutliveTheCook)
{
    EXPECT_THAT(faults("echo pack > $out; sleep 30 &"), ElementsAre("hearth cook leaves processes running"));
}

TEST_F(CheckAsset, reportsTooMuchMemoryOfAChild)
{
    Asset small = asset("must-not-crash");
    small.limits.rss_bytes = uint64_t{64} << 20;
    // tail keeps an unterminated last line
    const Finding finding = check(small, "head -c 300000000 /dev/zero | tail > /dev/null; echo pack > $out");
    EXPECT_THAT(finding.faults, Contains(HasSubstr("hearth cook needs more memory than 64 MiB")));
}

TEST_F(CheckAsset, asksForOneErrorLineThatNamesTheFile)
{
    EXPECT_THAT(faults("exit 65"), ElementsAre("says 0 error lines, not one"));
    EXPECT_THAT(faults("for i in 1 2; do echo \"$asset: error: $i\" >&2; done; exit 66"),
                ElementsAre("says 2 error lines, not one"));
    EXPECT_THAT(faults("echo 'pack.part: error: it is damaged' >&2; exit 65"),
                ElementsAre("the error does not name the file"));
}

TEST_F(CheckAsset, reportsWhatARejectionLeavesBehind)
{
    EXPECT_THAT(faults(std::string("echo half > $out; ") + kGoodReject), ElementsAre("leaves an output"));
    EXPECT_THAT(faults(std::string("mkdir parts; echo part > parts/0.part; ") + kGoodReject),
                ElementsAre("leaves parts behind", "leaves parts/0.part behind"));
}

TEST_F(CheckAsset, reportsFilesBesideThePack)
{
    EXPECT_THAT(faults("echo pack > $out; echo part > $TMPDIR/0.part"), ElementsAre("leaves 0.part behind"));
    EXPECT_THAT(faults("true"), ElementsAre("exits with 0 and writes no pack"));
}

TEST_F(CheckAsset, reportsNoiseOnStdoutAndControlCharacters)
{
    EXPECT_THAT(faults("echo done; echo pack > $out"), ElementsAre("writes to stdout"));
    EXPECT_THAT(faults("printf '\\033[2J' >&2; echo pack > $out"),
                ElementsAre("control characters of the asset reach the terminal"));
}

TEST_F(CheckAsset, reportsFilesOutsideTheFolderOfTheAsset)
{
    EXPECT_THAT(faults("cat $secret > /dev/null; echo pack > $out"),
                ElementsAre("opens " + root_ + "/secret, which is outside the asset's folder"));
    EXPECT_THAT(faults("cat $secret.png 2> /dev/null; echo pack > $out"),
                ElementsAre("opens " + root_ + "/secret.png, which is outside the asset's folder"));
    EXPECT_THAT(faults("ln -s $secret link.png; cat link.png > /dev/null; rm link.png; echo pack > $out"),
                ElementsAre("opens " + root_ + "/secret, which is outside the asset's folder"));
    EXPECT_THAT(faults("cat $asset > /dev/null; echo pack > $out"), IsEmpty());
}

TEST_F(CheckAsset, reportsWritingBesideTheAsset)
{
    EXPECT_THAT(faults("echo notes > ${asset%/*}/notes; echo pack > $out"),
                ElementsAre("writes to " + root_ + "/assets/notes"));
}

TEST_F(CheckAsset, allowsTheSystemFilesThatATrustedAssetOpens)
{
    const std::string cook = "cat $secret > /dev/null; echo pack > $out";
    EXPECT_THAT(faults(cook), SizeIs(1));
    Programs trusting = programs();
    trusting.allowed.system = traceSystemFiles(asset("must-not-crash"), trusting, root_ + "/work");
    EXPECT_THAT(trusting.allowed.system, ElementsAre(root_ + "/secret"));
    EXPECT_THAT(checkAsset(asset("must-not-crash"), trusting, root_ + "/work").faults, IsEmpty());
}

TEST_F(CheckAsset, asksForAPackThatVerifies)
{
    verify_ = "echo 'asset.hearth: error: bad [E3003]' >&2; exit 65";
    EXPECT_THAT(faults(kGoodCook),
                ElementsAre("hearth verify exits with 65: asset.hearth: error: bad [E3003]"));
}

TEST_F(CheckAsset, comparesTheCountsOfWhatMustLoad)
{
    Asset counted = asset("must-load");
    counted.counts = {{"triangles", 13}, {"vertices", 24}, {"materials", 1}};
    EXPECT_THAT(check(counted, kGoodCook).faults, ElementsAre("has 12 triangles, the manifest says 13",
                                                              "has 0 materials, the manifest says 1"));
}

TEST_F(CheckAsset, takesPolygonsForTheTrianglesOfAScan)
{
    Asset scan = asset("must-load");
    scan.counts = {{"triangles", 6}, {"faces", 6}, {"vertices", 24}};
    EXPECT_THAT(check(scan, kGoodCook).faults, IsEmpty());
}

TEST_F(CheckAsset, drawsWhatMustLoad)
{
    render_ = "echo 'hearth-render: error: VUID-1' >&2; exit 70";
    EXPECT_THAT(faults(kGoodCook, "must-load"),
                ElementsAre("hearth-render exits with 70: hearth-render: error: VUID-1"));
    render_ = "true";
    EXPECT_THAT(faults(kGoodCook, "must-load"), ElementsAre("hearth-render writes no image"));
    EXPECT_THAT(faults(kGoodCook, "must-not-crash"), IsEmpty());
}

TEST_F(CheckAsset, asksThatThePackBecomesAGlbThatIsImported)
{
    extract_ = "echo 'asset.hearth: error: a defect' >&2; exit 70";
    EXPECT_THAT(faults(kGoodCook),
                ElementsAre("hearth extract exits with 70: asset.hearth: error: a defect"));
    EXPECT_THAT(faults(kGoodReject), IsEmpty());
    extract_ = "true";
    import_ = "echo 'asset.glb: error: it is damaged' >&2; exit 65";
    EXPECT_THAT(faults(kGoodCook),
                ElementsAre("hearth-import of the GLB exits with 65: asset.glb: error: it is damaged"));
}

TEST_F(CheckAsset, wrapsSmallModels)
{
    wrap_ = "kill -SEGV $$";
    EXPECT_THAT(faults(kGoodCook), ElementsAre(HasSubstr("hearth-wrap is ended by signal 11")));
    Asset large = asset("must-not-crash");
    large.counts["triangles"] = 60'000;
    EXPECT_THAT(check(large, kGoodCook).faults, IsEmpty());
    Programs without = programs();
    without.wrap.clear();
    EXPECT_THAT(checkAsset(asset("must-not-crash"), without, root_ + "/work").faults, IsEmpty());
}

TEST_F(CheckAsset, readsTheManifest)
{
    std::ofstream(root_ + "/manifest.json") << R"({
        "good": [{"file": "good/a.glb", "bytes": 9, "files": [], "stratum": "draco", "expected": "must-load",
                  "counts": {"triangles": 12, "mode": "RGB", "channels": []}}],
        "bad": [{"file": "bad/b.glb", "bytes": 9, "files": [{}], "category": "gen-uri", "expected": "must-reject",
                 "confidence": "high", "limits": {"seconds": 10, "rss_mb": 1024}}]})";
    const Result<std::vector<Asset>> assets = readManifest(root_);
    ASSERT_TRUE(assets.ok()) << assets.error().detail;
    ASSERT_THAT(*assets, SizeIs(2));
    const Asset& good = (*assets)[0];
    EXPECT_TRUE(good.expected->mustLoad() && good.self_contained && good.confidence == Confidence::good);
    EXPECT_THAT(good.counts, ElementsAre(std::pair<const std::string, uint64_t>("triangles", 12)));
    const Asset& bad = (*assets)[1];
    EXPECT_EQ(bad.folder, root_ + "/bad");
    EXPECT_EQ(bad.category, "gen-uri");
    EXPECT_FALSE(bad.expected->may_load || bad.self_contained);
    EXPECT_EQ(bad.confidence, Confidence::high);
    EXPECT_EQ(bad.limits.rss_bytes, uint64_t{1} << 30);
}

TEST_F(CheckAsset, refusesAManifestWithAClassThatItDoesNotKnow)
{
    std::ofstream(root_ + "/manifest.json")
        << R"({"good": [{"file": "a.glb", "bytes": 9, "files": [], "stratum": "x", "expected": "may-hope"}], "bad": []})";
    EXPECT_FALSE(readManifest(root_).ok());
    EXPECT_FALSE(readManifest(root_ + "/nowhere").ok());
}

class Judge : public testing::Test
{
protected:
    Judge()
    {
        asset_.file = "bad/a.glb";
        asset_.expected = &assetClass("must-reject");
        asset_.confidence = Confidence::medium;
    }

    static Finding finding(Outcome outcome)
    {
        Finding finding;
        finding.outcome = outcome;
        return finding;
    }

    Verdict verdict(Outcome outcome) const { return judge(asset_, finding(outcome), judgements_).verdict; }

    Asset asset_;
    std::vector<Judgement> judgements_;
};

TEST_F(Judge, failsWhatIsOtherwiseThanItsClass)
{
    EXPECT_EQ(verdict(Outcome::rejects), Verdict::passed);
    EXPECT_EQ(verdict(Outcome::loads), Verdict::failed);
    EXPECT_EQ(verdict(Outcome::broken), Verdict::failed);
}

TEST_F(Judge, excusesAWrittenDeviation)
{
    judgements_ = {{"bad/a.glb", Outcome::loads, "it is tolerated"}};
    EXPECT_EQ(verdict(Outcome::loads), Verdict::judged);
    EXPECT_EQ(verdict(Outcome::broken), Verdict::failed);
}

TEST_F(Judge, failsAJudgementThatIsNotNeeded)
{
    judgements_ = {{"bad/a.glb", Outcome::loads, "it is tolerated"}};
    EXPECT_EQ(verdict(Outcome::rejects), Verdict::failed);
    EXPECT_THAT(strayJudgements({&asset_, 1}, judgements_), IsEmpty());
    judgements_[0].file = "bad/b.glb";
    EXPECT_THAT(strayJudgements({&asset_, 1}, judgements_), ElementsAre("bad/b.glb"));
}

TEST_F(Judge, excusesNothingThatIsCertain)
{
    judgements_ = {{"bad/a.glb", Outcome::loads, "it is tolerated"}};
    asset_.confidence = Confidence::high;
    EXPECT_EQ(verdict(Outcome::loads), Verdict::failed);
}

} // namespace

} // namespace hearth::corpus
