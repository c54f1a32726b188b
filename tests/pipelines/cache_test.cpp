// Tests the cache alone: whatever happens to its files, it returns the stored content or nothing.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/tools/sha256.h"
#include "formats/base/atomic_file.h"
#include "pipelines/cache/cache.h"
#include "pipelines/cache/cache_spec.h"
#include "pipelines/cache/directory_store.h"
#include "pipelines/cache/entry_text.h"
#include "pipelines/cache/maintenance.h"
#include "tests/support/sandbox.h"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hearth::cache
{

namespace
{

namespace fs = std::filesystem;
using test::Sandbox;
using tools::computeSha256;

const std::string kKey = computeSha256("key");
const Fields kEntry{{"made", "abc"}, {"warning", "one\ttwo\nthree\\"}, {"warning", ""}};

class CacheTest : public ::testing::Test
{
protected:
    /// Return a cache over the named folders of the sandbox; "ro" after a name: read only.
    Cache open(const std::vector<std::string>& names)
    {
        std::vector<std::unique_ptr<CacheLevel>> levels;
        for (const std::string& name : names)
        {
            const bool writable = !name.ends_with(" ro");
            levels.push_back(
                std::make_unique<DirectoryStore>(folder / name.substr(0, name.find(' ')), writable));
        }
        return Cache(std::move(levels),
                     [this](const Error& error) { warnings.push_back(formatMessage(error)); });
    }

    std::string put(Cache& cache, const std::string& content)
    {
        folder.write("content", content);
        cache.put(computeSha256(content), folder / "content", FileAccess::read_write);
        fs::remove(folder / "content");
        return computeSha256(content);
    }

    /// Return the content of the cache under the hash; "nothing" if there is none.
    std::string get(Cache& cache, const std::string& hash, FileAccess use = FileAccess::read_only)
    {
        fs::remove(folder / "fetched");
        return cache.fetch(hash, folder / "fetched", use) ? folder.read("fetched") : "nothing";
    }

    std::string getPath(const std::string& kind, const std::string& name) const
    {
        return folder / ("a/" + kind + "/" + name.substr(0, 2) + "/" + name);
    }

    /// Write to a file without write permission.
    static void overwrite(const std::string& path, const std::string& content)
    {
        fs::permissions(path, fs::perms::owner_all);
        std::ofstream(path, std::ios::binary | std::ios::trunc) << content;
    }

    Sandbox folder;
    std::vector<std::string> warnings;
};

} // namespace

TEST(Fields, comeBackFromTheirText)
{
    EXPECT_EQ(parseFields(formatFields(kEntry)), kEntry);
    EXPECT_EQ(parseFields(""), Fields());
    const std::string text = formatEntry(kEntry);
    EXPECT_EQ(parseEntry(text), kEntry);
    for (size_t size = 0; size < text.size(); ++size)
        EXPECT_EQ(parseEntry(text.substr(0, size)), std::nullopt) << size;
    for (size_t i = 0; i < text.size(); ++i)
    {
        std::string flipped = text;
        flipped[i] = static_cast<char>(flipped[i] ^ 1);
        EXPECT_EQ(parseEntry(flipped), std::nullopt) << i;
    }
}

TEST(Fields, refuseWhatNobodyWrote)
{
    for (const char* text : {"a", "a\n", "a\tb", "a\tb\tc\n", "a\t\\x\n", "a\t\\"})
        EXPECT_EQ(parseFields(text), std::nullopt) << text;
}

TEST_F(CacheTest, handsOutWhatWasPutIn)
{
    Cache cache = open({"a"});
    EXPECT_EQ(cache.entry(kKey), std::nullopt);
    cache.putEntry(kKey, kEntry);
    EXPECT_EQ(cache.entry(kKey), kEntry);
    const std::string hash = put(cache, "some bytes");
    EXPECT_EQ(get(cache, hash), "some bytes");
    EXPECT_EQ(get(cache, computeSha256("other")), "nothing");
    EXPECT_EQ(warnings, std::vector<std::string>{});
    EXPECT_TRUE(fs::is_empty(folder / "a/tmp"));
}

TEST_F(CacheTest, whoGetsAFileToKeepCannotHarmTheCache)
{
    Cache cache = open({"a"});
    const std::string hash = put(cache, "some bytes");
    ASSERT_EQ(get(cache, hash, FileAccess::read_write), "some bytes");
    overwrite(folder / "fetched", "scribble");
    EXPECT_EQ(get(cache, hash), "some bytes");
    struct stat stored = {};
    struct stat fetched = {};
    ::stat(getPath("cas", hash).c_str(), &stored);
    ::stat((folder / "fetched").c_str(), &fetched);
    EXPECT_EQ(stored.st_ino, fetched.st_ino) << "what is only read need not be copied";
}

TEST_F(CacheTest, damageIsToldAndMendedByTheNextWriter)
{
    Cache cache = open({"a"});
    cache.putEntry(kKey, kEntry);
    const std::string hash = put(cache, "some bytes");
    for (const std::string damage : {"", "some", "sOme bytes", "some bytes and more"})
    {
        warnings.clear();
        overwrite(getPath("cas", hash), damage);
        EXPECT_EQ(get(cache, hash), "nothing");
        EXPECT_EQ(warnings.size(), 1u);
        EXPECT_EQ(put(cache, "some bytes"), hash);
        EXPECT_EQ(get(cache, hash), "some bytes");
    }
    warnings.clear();
    overwrite(getPath("ac", kKey), "hearth.entry/1 torn");
    EXPECT_EQ(cache.entry(kKey), std::nullopt);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("warning: entry " + kKey + " is damaged: it is made again [W4100]"),
              std::string::npos)
        << warnings[0];
    cache.putEntry(kKey, kEntry);
    EXPECT_EQ(cache.entry(kKey), kEntry);
}

TEST_F(CacheTest, nearLevelsTakeWhatFarOnesHave)
{
    {
        Cache far = open({"b"});
        far.putEntry(kKey, kEntry);
        put(far, "some bytes");
    }
    {
        Cache both = open({"a", "b ro"});
        EXPECT_EQ(both.entry(kKey), kEntry);
        EXPECT_EQ(get(both, computeSha256("some bytes")), "some bytes");
        put(both, "new bytes");
    }
    Cache near = open({"a"});
    EXPECT_EQ(near.entry(kKey), kEntry);
    EXPECT_EQ(get(near, computeSha256("some bytes")), "some bytes");
    EXPECT_EQ(get(near, computeSha256("new bytes")), "new bytes");
    Cache far = open({"b"});
    EXPECT_EQ(get(far, computeSha256("new bytes")), "nothing") << "it is read only";
}

TEST_F(CacheTest, aLevelThatFailsIsToldOfOnceAndLeftAlone)
{
    folder.write("a", "a file, where a folder should be");
    Cache cache = open({"a", "b"});
    cache.putEntry(kKey, kEntry);
    cache.putEntry(computeSha256("other"), kEntry);
    const std::string hash = put(cache, "some bytes");
    EXPECT_EQ(warnings.size(), 1u);
    EXPECT_EQ(cache.entry(kKey), kEntry);
    EXPECT_EQ(get(cache, hash), "some bytes");
}

TEST_F(CacheTest, aFullDiskCostsOnlyWhatIsNotKept)
{
    // a file size limit in a separate process stands for a full disk
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0)
    {
        std::signal(SIGXFSZ, SIG_IGN);
        folder.write("content", std::string(100000, 'x'));
        const rlimit limit{4096, 4096};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        Cache cache = open({"a"});
        cache.put(computeSha256(std::string(100000, 'x')), folder / "content", FileAccess::read_write);
        cache.putEntry(kKey, kEntry);
        ::_exit(warnings.size() == 1 && !cache.isWritable() && fs::is_empty(folder / "a/tmp") ? 0 : 1);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    Cache cache = open({"a"});
    EXPECT_EQ(get(cache, computeSha256(std::string(100000, 'x'))), "nothing");
    EXPECT_EQ(warnings, std::vector<std::string>{}) << "nothing torn is there";
}

TEST_F(CacheTest, sixWritersOfOneKeyLeaveItWhole)
{
    const std::string content(300000, 'x');
    folder.write("source", content);
    std::vector<pid_t> writers;
    for (int writer = 0; writer < 6; ++writer)
    {
        const pid_t child = ::fork();
        ASSERT_GE(child, 0);
        if (child != 0)
        {
            writers.push_back(child);
            continue;
        }
        Cache cache = open({"a"});
        for (int round = 0; round < 20; ++round)
        {
            cache.put(computeSha256(content), folder / "source", FileAccess::read_write);
            cache.putEntry(kKey, kEntry);
            const std::string own = folder / std::to_string(writer);
            static_cast<void>(cache.entry(kKey));
            static_cast<void>(cache.fetch(computeSha256(content), own, FileAccess::read_only));
            fs::remove(own);
            // other processes are still writing these
            if (writer == 0)
                DirectoryStore(folder / "a", true).removeContent(computeSha256(content));
        }
        ::_exit(warnings.empty() ? 0 : 1);
    }
    for (const pid_t writer : writers)
    {
        int status = 0;
        ::waitpid(writer, &status, 0);
        EXPECT_EQ(status, 0);
    }
    EXPECT_EQ(verifyFolder(folder / "a"), std::vector<std::string>{});
    EXPECT_TRUE(fs::is_empty(folder / "a/tmp"));
}

TEST_F(CacheTest, garbageGoesFromWhatWasUsedLeast)
{
    Cache cache = open({"a"});
    std::vector<std::string> keys;
    for (int i = 0; i < 4; ++i)
    {
        const std::string hash = put(cache, std::string(10000, static_cast<char>('a' + i)));
        keys.push_back(computeSha256(std::to_string(i)));
        cache.putEntry(keys.back(), {{std::string(kContentField), hash}});
        fs::last_write_time(getPath("ac", keys.back()),
                            fs::file_time_type::clock::now() - std::chrono::hours(24 * (4 - i)));
    }
    // a lookup makes it the most recent entry
    EXPECT_TRUE(cache.entry(keys[0]).has_value());
    EXPECT_EQ(measureOccupancy(folder / "a").contents, 4u);
    // named by no entry, one day old
    const std::string lost = put(cache, "lost");
    fs::last_write_time(getPath("cas", lost), fs::file_time_type::clock::now() - std::chrono::hours(24));

    const Occupancy left = collectGarbage(folder / "a", 21000);
    EXPECT_EQ(left.entries, 2u);
    EXPECT_EQ(left.contents, 2u);
    EXPECT_LE(left.bytes, 21000u);
    EXPECT_EQ(measureOccupancy(folder / "a").bytes, left.bytes);
    EXPECT_TRUE(cache.entry(keys[0]).has_value());
    EXPECT_TRUE(cache.entry(keys[3]).has_value());
    EXPECT_EQ(get(cache, lost), "nothing");
    EXPECT_EQ(verifyFolder(folder / "a"), std::vector<std::string>{});
    EXPECT_EQ(collectGarbage(folder / "a", 1).bytes, 0u);
}

TEST_F(CacheTest, keepsItselfWithinItsLimit)
{
    Cache cache = open({"a"});
    for (int i = 0; i < 10; ++i)
    {
        const std::string hash = put(cache, std::string(10000, static_cast<char>('a' + i)));
        cache.putEntry(computeSha256(std::to_string(i)), {{std::string(kContentField), hash}});
        recordGrowth(folder / "a", 10200, 50000);
        EXPECT_LE(measureOccupancy(folder / "a").bytes, 50000u);
    }
    EXPECT_GE(measureOccupancy(folder / "a").contents, 3u);
}

TEST_F(CacheTest, verifyFindsAndRemovesDamage)
{
    Cache cache = open({"a"});
    const std::string hash = put(cache, "some bytes");
    cache.putEntry(kKey, {{std::string(kContentField), hash}});
    EXPECT_EQ(verifyFolder(folder / "a"), std::vector<std::string>{});
    overwrite(getPath("cas", hash), "same bytes");
    EXPECT_EQ(verifyFolder(folder / "a"), (std::vector<std::string>{"content " + hash, "entry " + kKey}));
    EXPECT_EQ(measureOccupancy(folder / "a").bytes, 0u);
}

TEST(CacheSpecs, comeFromTheCommandLineElseTheEnvironmentElseTheUser)
{
    ::setenv("HEARTH_CACHE", "dir:/x;dir:/y,ro,size=3M", 1);
    const auto specs = resolveCacheSpecs({}).value();
    ASSERT_EQ(specs.size(), 2u);
    EXPECT_EQ(specs[0].place, "/x");
    EXPECT_TRUE(specs[0].writable);
    EXPECT_EQ(specs[1].place, "/y");
    EXPECT_FALSE(specs[1].writable);
    EXPECT_EQ(specs[1].limit_bytes, 3u << 20);
    const std::vector<std::string> options{"dir:/z"};
    EXPECT_EQ(resolveCacheSpecs(options).value().at(0).place, "/z");
    ::setenv("HEARTH_CACHE", "off", 1);
    EXPECT_TRUE(resolveCacheSpecs({}).value().empty());
    ::unsetenv("HEARTH_CACHE");
    ::setenv("XDG_CACHE_HOME", "/home/x/caches", 1);
    EXPECT_EQ(resolveCacheSpecs({}).value().at(0).place, "/home/x/caches/hearth");
    ::unsetenv("XDG_CACHE_HOME");
    ::setenv("HOME", "/home/x", 1);
    EXPECT_EQ(resolveCacheSpecs({}).value().at(0).place, "/home/x/.cache/hearth");
    const std::vector<std::string> servers{"http://cache:8080/team/,ro", "https://me:secret@cache"};
    const auto far = resolveCacheSpecs(servers).value();
    EXPECT_EQ(far.at(0).place, "http://cache:8080/team");
    EXPECT_TRUE(far.at(0).is_server);
    EXPECT_FALSE(far.at(0).writable);
    EXPECT_EQ(far.at(1).place, "https://me:secret@cache");
    EXPECT_TRUE(far.at(1).writable);
    for (const char* wrong :
         {"/x", "ftp://x", "http://", "http:///x", "http://:80/x", "http://me@/x", "http://x/?y=1",
          "http://x/a b", "http://x,rw", "http://x,size=1G", "dir:", "dir:/x,rw",
          "dir:/x,size=", "dir:/x,size=0", "dir:/x,size=9P", "dir:/x,size=99999999999T"})
    {
        const std::vector<std::string> option{wrong};
        const auto refused = resolveCacheSpecs(option);
        ASSERT_FALSE(refused.ok()) << wrong;
        EXPECT_EQ(refused.error().issue, Issue::usage);
    }
}

} // namespace hearth::cache
