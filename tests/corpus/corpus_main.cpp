// hearth_corpus: cooks every file of the asset corpus and compares the outcomes with the manifest.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "formats/base/program.h"
#include "tests/corpus/report.h"

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <sys/resource.h>
#include <thread>

namespace
{

using namespace hearth;
using namespace hearth::corpus;
namespace fs = std::filesystem;

constexpr int kSkipped = 77; // CTest reads it as "skipped"

// Limits endless output, so that a defect cannot fill the disk: four times the largest source's pack.
constexpr rlim_t kMaxFileBytes = rlim_t{4} << 30;

struct Arguments
{
    std::string programs;
    unsigned jobs = 2;
    std::string filter;
    std::string class_name;
    std::string category;
    bool good = false;
    bool bad = false;
    bool list_medium = false;
    bool no_render = false;
};

bool chosen(const Asset& asset, const Arguments& arguments)
{
    const bool is_good = asset.confidence == Confidence::good;
    return asset.file.find(arguments.filter) != std::string::npos &&
           (arguments.class_name.empty() || asset.expected->name == arguments.class_name) &&
           (arguments.category.empty() || asset.category == arguments.category) &&
           (arguments.good == arguments.bad || is_good == arguments.good);
}

/// Temporary folder of the run, removed by the destructor.
class WorkFolder
{
public:
    WorkFolder() : path_((fs::temp_directory_path() / "hearth-corpus-XXXXXX").string())
    {
        if (::mkdtemp(path_.data()) == nullptr)
            path_.clear();
    }
    ~WorkFolder()
    {
        std::error_code ignored;
        if (!path_.empty())
            fs::remove_all(path_, ignored);
    }
    WorkFolder(const WorkFolder&) = delete;
    WorkFolder& operator=(const WorkFolder&) = delete;

    const std::string& path() const { return path_; }

    std::string forWorker(unsigned worker) const
    {
        std::string folder = path_ + "/" + std::to_string(worker);
        fs::create_directory(folder);
        return folder;
    }

private:
    std::string path_;
};

/// Return the files that the programs open on this system for any asset. Learnt from one valid file of each
/// kind, the smallest that refers to no other file.
std::set<std::string> learnSystemFiles(const std::vector<Asset>& assets, const Programs& programs,
                                       const std::string& work)
{
    std::map<std::string, const Asset*> samples;
    for (const Asset& asset : assets)
    {
        if (asset.confidence != Confidence::good || !asset.self_contained || !asset.expected->mustLoad())
            continue;
        const Asset*& sample = samples[fs::path(asset.file).extension().string()];
        if (sample == nullptr || asset.bytes < sample->bytes)
            sample = &asset;
    }
    std::set<std::string> files;
    for (const auto& [kind, asset] : samples)
        files.merge(traceSystemFiles(*asset, programs, work));
    return files;
}

/// Check files, `jobs` at once. A limit of seconds holds for a file that has the machine to itself: files
/// that share it get as many times longer.
std::vector<Checked> checkAll(const std::vector<const Asset*>& assets, const Programs& programs,
                              const WorkFolder& work, unsigned jobs)
{
    std::vector<Checked> all(assets.size());
    std::atomic<size_t> next = 0;
    const auto worker = [&](unsigned number)
    {
        const std::string folder = work.forWorker(number);
        for (size_t i = next++; i < assets.size(); i = next++)
        {
            Asset asset = *assets[i];
            asset.limits.seconds *= jobs;
            all[i] = judge(*assets[i], checkAsset(asset, programs, folder), kJudgements);
        }
    };
    std::vector<std::jthread> threads;
    for (unsigned i = 0; i < jobs; ++i)
        threads.emplace_back(worker, i);
    threads.clear();
    return all;
}

int report(const std::vector<Checked>& all, const std::vector<std::string>& stray, const Arguments& arguments)
{
    printFailures(all);
    for (const std::string& file : stray)
        std::printf("FAILED %s\n    has a judgement, and is not in the manifest\n", file.c_str());
    if (arguments.list_medium)
        printMedium(all);
    printSlowest(all);
    printTable(all);
    const auto failed = static_cast<size_t>(std::count_if(
        all.begin(), all.end(), [](const Checked& checked) { return checked.verdict == Verdict::failed; }));
    std::printf("%zu passed, %zu failed\n", all.size() - failed, failed + stray.size());
    return failed + stray.size() == 0 ? 0 : 1;
}

int run(const Arguments& arguments)
{
    const char* folder = std::getenv("HEARTH_ASSETS");
    if (folder == nullptr || *folder == '\0')
    {
        std::puts("skipped: HEARTH_ASSETS does not name the folder of the asset corpus");
        return kSkipped;
    }
    const Result<std::vector<Asset>> assets = readManifest(folder);
    if (!assets.ok())
    {
        return reportFailure(assets.error());
    }
    const std::string bin = fs::canonical(arguments.programs).string();
    // hearth-wrap is built where CGAL is
    const std::string wrap = bin + "/hearth-wrap";
    Programs programs{.hearth = bin + "/hearth",
                      .import = bin + "/hearth-import",
                      .render = arguments.no_render ? "" : bin + "/hearth-render",
                      .wrap = fs::exists(wrap) ? wrap : "",
                      .allowed = {bin, {}}};
    if (programs.wrap.empty())
        std::puts("hearth-wrap is not built: nothing is wrapped");
    std::vector<const Asset*> assets_chosen;
    for (const Asset& asset : *assets)
        if (chosen(asset, arguments))
            assets_chosen.push_back(&asset);
    if (assets_chosen.empty())
    {
        std::fputs("hearth_corpus: no file is chosen\n", stderr);
        return 2;
    }

    const WorkFolder work;
    programs.allowed.system = learnSystemFiles(*assets, programs, work.forWorker(0));
    const std::vector<Checked> all = checkAll(assets_chosen, programs, work, arguments.jobs);
    return report(all, strayJudgements(*assets, kJudgements), arguments);
}

} // namespace

int main(int argc, char** argv)
try
{
    cli::CommandLine app(
        "Cooks the files of $HEARTH_ASSETS/manifest.json and checks each against its class.");
    Arguments arguments;
    app.addOption("--bin", arguments.programs, "folder of the programs to test")
        .required()
        .typeName("DIR")
        .check([](const std::string& path)
               { return fs::is_directory(path) ? "" : "'" + path + "' is no folder"; });
    app.addOption("-j,--jobs", arguments.jobs, "files at once").range(1, 256).showDefault();
    app.addOption("--filter", arguments.filter, "only files whose path contains this");
    app.addOption("--class", arguments.class_name, "only files of this class");
    app.addOption("--category", arguments.category, "only files of this category");
    app.addFlag("--good", arguments.good, "only good files");
    app.addFlag("--bad", arguments.bad, "only bad files");
    app.addFlag("--list-medium", arguments.list_medium,
                "print the files of medium confidence that come out otherwise than their class");
    app.addFlag("--no-render", arguments.no_render, "do not draw the packs");
    app.setFooter(
        "Example: HEARTH_ASSETS=../shared/assets hearth_corpus --bin build/release/bin --category gen-uri\n"
        "Exit codes: 0 every file meets its class, 1 some do not, 2 usage, 77 skipped: no assets");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    // the children inherit these limits: no core files, and no endless files
    const rlimit no_core{0, 0};
    const rlimit file_size{kMaxFileBytes, kMaxFileBytes};
    ::setrlimit(RLIMIT_CORE, &no_core);
    ::setrlimit(RLIMIT_FSIZE, &file_size);
    adoptOrphans();
    return run(arguments);
}
catch (const std::exception& error)
{
    std::fprintf(stderr, "hearth_corpus: %s\n", error.what());
    return 70;
}
