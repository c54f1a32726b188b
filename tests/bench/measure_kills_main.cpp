// Kills cooks by SIGKILL at random moments, `hearth` alone and with all its cookers in turns, and checks what
// they leave: the pack is the old or the new one, the next cook is not hindered and makes the bytes of a cook
// that nothing disturbed, the cache verifies, and no temporary folder stays. `./dev bench kills` runs it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/tools/child_processes.h"
#include "formats/base/program.h"
#include "tests/bench/aims.h"
#include "tests/support/sandbox.h"
#include "tests/support/small_sources.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <random>
#include <thread>

namespace
{

using namespace hearth;
namespace fs = std::filesystem;

using Words = std::vector<std::string>;
using Seconds = std::chrono::duration<double>;

const Words kNoEnvironment{"TMPDIR="}; ///< temporary folders are made beside the pack

struct Counts
{
    int at_work = 0;   ///< kills of a cook that had not ended
    int new_packs = 0; ///< kills after which the new pack was in its place
    // failed checks
    int torn_packs = 0;
    int failed_cooks = 0;
    int different_packs = 0;
    int leftovers = 0;
    int damaged_caches = 0;

    int countDamage() const
    {
        return torn_packs + failed_cooks + different_packs + leftovers + damaged_caches;
    }
};

/// A folder with sources, the pack that their cook makes, and another, older one.
class CookFolder
{
public:
    CookFolder()
    {
        test::writeObj(folder_, "house");
        test::writeObj(folder_, "shed", 2);
        test::writeGltf(folder_, "tree");
        test::writeGltf(folder_, "bush", 0.5f);
        mustRun({programs_ + "/hearth-samples", "rock", "--triangles", "60000", "--texture-size", "256", "-o",
                 "rock.glb"});
        mustRun({programs_ + "/hearth", "cook", "-q", "--no-cache", "house.obj", "-o", "old.hearth"});
        old_pack_ = folder_.read("old.hearth");
        fs::remove(folder_ / "old.hearth");
        for (int run = 0; run < 3; ++run)
            measureWholeCook();
        files_ = folder_.list();
    }

    double cookSeconds() const { return cook_seconds_; }

    /// Kill one cook and check what follows.
    /// over_old_pack  the cook replaces another pack
    /// with_cookers   kill all processes of the cook, else `hearth` alone
    void kill(double after_seconds, bool over_old_pack, bool with_cookers, Counts& counts)
    {
        fs::remove_all(folder_.cachePath());
        if (over_old_pack)
            folder_.write("a.hearth", old_pack_);
        Words command = makeCook("a.hearth");
        command.insert(command.begin(), "/usr/bin/setsid"); // a group of processes of its own
        const pid_t process = folder_.start(command, kNoEnvironment);
        std::this_thread::sleep_for(Seconds(after_seconds));
        if (with_cookers)
            ::kill(-process, SIGKILL);
        ::kill(process, SIGKILL);
        counts.at_work += folder_.finish(process).exit_code == -1 ? 1 : 0;
        const std::string left = folder_.has("a.hearth") ? folder_.read("a.hearth") : "";
        if (left == whole_pack_)
            ++counts.new_packs;
        else if (left != (over_old_pack ? old_pack_ : ""))
            ++counts.torn_packs;
        checkNextCook(counts);
        fs::remove(folder_ / "a.hearth");
    }

private:
    Words makeCook(const std::string& pack) const
    {
        return {programs_ + "/hearth", "cook",      "-q",       "house.obj", "shed.obj",
                "tree.gltf",           "bush.gltf", "rock.glb", "-o",        pack};
    }

    test::ProgramEnd run(const Words& command) { return folder_.run(command, kNoEnvironment); }

    void mustRun(const Words& command)
    {
        const test::ProgramEnd end = run(command);
        if (end.exit_code != 0)
            throw std::runtime_error(command[0] + " failed: " + end.err);
    }

    void measureWholeCook()
    {
        fs::remove_all(folder_.cachePath());
        const auto start = std::chrono::steady_clock::now();
        mustRun(makeCook("a.hearth"));
        cook_seconds_ = std::max(cook_seconds_, Seconds(std::chrono::steady_clock::now() - start).count());
        whole_pack_ = folder_.read("a.hearth");
        fs::remove(folder_ / "a.hearth");
    }

    void checkNextCook(Counts& counts)
    {
        Words command = makeCook("a.hearth");
        command.insert(command.begin(), {"/usr/bin/timeout", "--signal=KILL", "60"}); // for a stale lock
        const test::ProgramEnd end = run(command);
        if (end.exit_code != 0)
        {
            std::printf("the next cook ends with %d: %s\n", end.exit_code, end.err.c_str());
            ++counts.failed_cooks;
        }
        else if (folder_.read("a.hearth") != whole_pack_)
            ++counts.different_packs;
        if (!removesLeftovers())
            ++counts.leftovers;
        const test::ProgramEnd verified = run({programs_ + "/hearth", "cache", "verify"});
        if (verified.exit_code != 0)
        {
            std::printf("the cache: %s%s\n", verified.out.c_str(), verified.err.c_str());
            ++counts.damaged_caches;
        }
    }

    bool hasLeftovers() const
    {
        const std::vector<std::string> names = folder_.list();
        return std::any_of(names.begin(), names.end(),
                           [&](const std::string& name) {
                               return name != "a.hearth" &&
                                      std::find(files_.begin(), files_.end(), name) == files_.end();
                           });
    }

    /// Cook until the folder of the killed cook is gone: a cooker that outlives `hearth` may write into it
    /// while it is being removed.
    bool removesLeftovers()
    {
        for (int tries = 0; tries < 20 && hasLeftovers(); ++tries)
        {
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
            run({programs_ + "/hearth", "cook", "-q", "-f", "house.obj", "-o", "other.hearth"});
            fs::remove(folder_ / "other.hearth");
        }
        return !hasLeftovers();
    }

    test::Sandbox folder_;
    std::string programs_ = tools::programFolder();
    std::string old_pack_, whole_pack_;
    std::vector<std::string> files_; ///< names that are in the folder between cooks
    double cook_seconds_ = 0;        ///< of the slowest undisturbed cook
};

int program(int argc, char** argv)
{
    cli::CommandLine app("Kills cooks at random moments and checks what they leave.", "hearth_measure_kills");
    int kills = 100;
    uint32_t seed = 1;
    app.addOption("--kills", kills, "cooks to kill").range(1, 100000);
    app.addOption("--seed", seed, "of the random moments");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;

    CookFolder folder;
    std::mt19937 random(seed);
    Counts counts;
    for (int i = 0; i < kills; ++i)
    {
        // each second one in the last fifth and a little later, where the pack is written
        const double from = i % 2 == 0 ? 0 : 0.8;
        const double moment =
            std::uniform_real_distribution<double>(from, 1.05)(random) * folder.cookSeconds();
        const int before = counts.countDamage();
        folder.kill(moment, i / 2 % 2 != 0, i / 4 % 2 != 0, counts);
        if (counts.countDamage() != before)
            std::printf("kill %d, after %.3f s, broke something\n", i, moment);
    }
    std::printf("%d cooks of %.2f s killed, %d of them at work, %d with the new pack in its place: %d torn "
                "packs, %d next cooks failed, %d with other bytes, %d with folders left, %d damaged caches\n",
                kills, folder.cookSeconds(), counts.at_work, counts.new_packs, counts.torn_packs,
                counts.failed_cooks, counts.different_packs, counts.leftovers, counts.damaged_caches);
    bench::Judgement judgement("kills");
    judgement.record("packs, caches or folders that a kill broke", counts.countDamage());
    judgement.record("kills that caught a cook at work", counts.at_work);
    return judgement.finish();
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth_measure_kills", [&] { return program(argc, argv); });
}
