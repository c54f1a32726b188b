// Tests the cache level on a server under all kinds of server failures: it returns the stored content or
// nothing, and soon.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/tools/sha256.h"
#include "pipelines/cache/cache.h"
#include "pipelines/cache/directory_store.h"
#include "pipelines/cache/http_store.h"
#include "tests/support/sandbox.h"
#include "tests/support/web_server.h"

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

namespace hearth::cache
{

namespace
{

namespace fs = std::filesystem;
using test::Sandbox;
using tools::computeSha256;

const std::string kKey = computeSha256("key");
const Fields kEntry{{"made", "abc"}, {"warning", "one\ttwo\nthree\\"}};
constexpr StallLimits kShort{0.3, 0.25, 256 * 1024, 0.3};

class HttpTest : public ::testing::Test
{
protected:
    Cache open(const std::string& url, const StallLimits& pace = {}, bool writable = true)
    {
        std::vector<std::unique_ptr<CacheLevel>> levels;
        levels.push_back(std::make_unique<HttpStore>(url, writable, pace));
        return Cache(std::move(levels),
                     [this](const Error& error) { warnings.push_back(formatMessage(error)); });
    }

    std::string put(Cache& cache, const std::string& content)
    {
        folder.write("content", content);
        cache.put(computeSha256(content), folder / "content", FileAccess::read_write);
        return computeSha256(content);
    }

    /// Return the content of the cache under the hash; "nothing" if there is none.
    std::string get(Cache& cache, const std::string& hash)
    {
        fs::remove(folder / "fetched");
        if (cache.fetch(hash, folder / "fetched", FileAccess::read_only))
            return folder.read("fetched");
        EXPECT_FALSE(folder.has("fetched"));
        return "nothing";
    }

    static std::string entryAnswer(const std::string& body)
    {
        return "HTTP/1.1 200 OK\r\nContent-Length: " + std::to_string(body.size()) +
               "\r\nConnection: close\r\n\r\n" + body;
    }

    /// Check for exactly one warning, which contains `part`.
    void expectWarning(const std::string& part)
    {
        ASSERT_EQ(warnings.size(), 1u);
        EXPECT_NE(warnings[0].find(part), std::string::npos) << warnings[0];
        EXPECT_NE(warnings[0].find("[W4100]"), std::string::npos) << warnings[0];
    }

    Sandbox folder;
    std::vector<std::string> warnings;
};

/// Fixture with nginx over a folder.
class NginxTest : public HttpTest
{
protected:
    void SetUp() override
    {
        if (!test::WebServer::isInstalled())
            GTEST_SKIP() << "nginx is not installed (Debian's nginx-light)";
        ::setenv("no_proxy", "127.0.0.1", 1);
        server = std::make_unique<test::WebServer>(server_folder.path());
    }

    Sandbox server_folder;
    std::unique_ptr<test::WebServer> server;
};

} // namespace

TEST(StallTimer, endsWhereAServerLiesBehindForLong)
{
    const StallLimits pace{5, 0.25, 1000, 3};
    StallTimer stalled(pace);
    EXPECT_TRUE(stalled.addWait(4.9, 0, 0));
    EXPECT_FALSE(stalled.addWait(0.2, 0, 0));
    StallTimer fast(pace);
    EXPECT_TRUE(fast.addWait(1, 10000, 0));
    EXPECT_FALSE(fast.addWait(5.1, 0, 0)) << "what it did before is no excuse";
    StallTimer steady(pace);
    for (int i = 0; i < 1000; ++i)
        EXPECT_TRUE(steady.addWait(1, 0, 1001));
    StallTimer dripping(pace);
    int seconds = 0;
    while (dripping.addWait(1, 0, 500))
        ++seconds;
    EXPECT_EQ(seconds, 10);
}

TEST(WithoutUser, leavesOutWhatIsNobodysBusiness)
{
    EXPECT_EQ(withoutCredentials("http://cache:8080/a@b"), "http://cache:8080/a@b");
    EXPECT_EQ(withoutCredentials("https://me:secret@cache/a"), "https://cache/a");
    EXPECT_EQ(withoutCredentials("https://me@cache"), "https://cache");
}

TEST_F(NginxTest, handsOutWhatWasPutIn)
{
    Cache cache = open(server->url());
    EXPECT_EQ(cache.entry(kKey), std::nullopt);
    cache.putEntry(kKey, kEntry);
    EXPECT_EQ(cache.entry(kKey), kEntry);
    for (const size_t size : {size_t{0}, size_t{1}, size_t{100000}, size_t{5} << 20})
    {
        const std::string content(size, static_cast<char>('a' + size % 7));
        const std::string hash = put(cache, content);
        EXPECT_EQ(get(cache, hash), content) << size;
    }
    EXPECT_EQ(get(cache, computeSha256("other")), "nothing");
    EXPECT_EQ(warnings, std::vector<std::string>{});
    EXPECT_TRUE(fs::exists(server->store() + "/ac/" + kKey));
    Cache other = open(server->url(), {}, false);
    EXPECT_EQ(other.entry(kKey), kEntry);
    other.putEntry(computeSha256("other"), kEntry);
    EXPECT_FALSE(fs::exists(server->store() + "/ac/" + computeSha256("other"))) << "it is read only";
}

TEST_F(NginxTest, answersManyQuestionsAtOnceAndKeepsTheirOrder)
{
    constexpr size_t kCount = 300;
    HttpStore level(server->url(), true);
    std::vector<EntryRequest> entries;
    std::vector<ContentRequest> contents;
    for (size_t i = 0; i < kCount; ++i)
    {
        const std::string text = "text " + std::to_string(i);
        entries.push_back({computeSha256(text), std::nullopt});
        contents.push_back(
            {computeSha256(text), folder / ("fetched" + std::to_string(i)), FileAccess::read_only});
        if (i % 3 == 0)
            continue;
        ASSERT_TRUE(level.putEntry(entries[i].key, text).ok());
        folder.write("content", text);
        ASSERT_TRUE(level.put(contents[i].hash, folder / "content", FileAccess::read_write).ok());
    }
    ASSERT_TRUE(level.entries(entries).ok());
    ASSERT_TRUE(level.fetch(contents).ok());
    for (size_t i = 0; i < kCount; ++i)
    {
        const std::string text = "text " + std::to_string(i);
        EXPECT_EQ(entries[i].text, i % 3 == 0 ? std::nullopt : std::optional(text));
        EXPECT_EQ(contents[i].is_found, i % 3 != 0);
        EXPECT_EQ(folder.has("fetched" + std::to_string(i)), i % 3 != 0);
        EXPECT_TRUE(i % 3 == 0 || folder.read("fetched" + std::to_string(i)) == text);
    }
}

TEST_F(NginxTest, nearLevelsTakeWhatTheServerHas)
{
    {
        Cache far = open(server->url());
        far.putEntry(kKey, kEntry);
        put(far, "some bytes");
    }
    std::vector<std::unique_ptr<CacheLevel>> levels;
    levels.push_back(std::make_unique<DirectoryStore>(folder / "near", true));
    levels.push_back(std::make_unique<HttpStore>(server->url(), true));
    Cache both(std::move(levels), [](const Error& error) { FAIL() << formatMessage(error); });
    EXPECT_EQ(both.entry(kKey), kEntry);
    EXPECT_EQ(get(both, computeSha256("some bytes")), "some bytes");
    put(both, "new bytes");
    server->stop();
    EXPECT_EQ(both.entry(kKey), kEntry);
    EXPECT_EQ(get(both, computeSha256("some bytes")), "some bytes");
    EXPECT_TRUE(fs::exists(server->store() + "/cas/" + computeSha256("new bytes")));
}

TEST_F(NginxTest, damageIsToldAndMendedByTheNextWriter)
{
    Cache cache = open(server->url());
    cache.putEntry(kKey, kEntry);
    const std::string hash = put(cache, "some bytes");
    const auto overwrite = [&](const std::string& path, const std::string& content)
    { std::ofstream(server->store() + path, std::ios::binary) << content; };
    for (const std::string damage : {"", "some", "sOme bytes", "some bytes and more"})
    {
        warnings.clear();
        overwrite("/cas/" + hash, damage);
        EXPECT_EQ(get(cache, hash), "nothing");
        expectWarning("content " + hash + " is damaged: it is made again");
        EXPECT_EQ(put(cache, "some bytes"), hash);
        EXPECT_EQ(get(cache, hash), "some bytes");
    }
    warnings.clear();
    overwrite("/ac/" + kKey, "hearth.entry/1 torn");
    EXPECT_EQ(cache.entry(kKey), std::nullopt);
    expectWarning("entry " + kKey + " is damaged: it is made again");
    cache.putEntry(kKey, kEntry);
    EXPECT_EQ(cache.entry(kKey), kEntry);
}

TEST_F(NginxTest, takesNoMoreThanItAskedFor)
{
    Cache cache = open(server->url());
    const std::string hash = put(cache, "some bytes");
    std::ofstream(server->store() + "/cas/" + hash, std::ios::binary) << std::string(1 << 20, 'x');
    ContentRequest wanted{hash, folder / "fetched", FileAccess::read_only, 10};
    cache.fetch({&wanted, 1});
    EXPECT_FALSE(wanted.is_found);
    EXPECT_FALSE(folder.has("fetched"));
    expectWarning("is damaged");
}

TEST_F(NginxTest, aServerThatTakesNothingIsStillRead)
{
    Cache cache = open(server->url());
    cache.putEntry(kKey, kEntry);
    for (const std::string refusal :
         {"client_max_body_size 1k;", "if ($request_method = PUT) { return 507; }",
          "if ($request_method = PUT) { return 403; }", "if ($request_method = PUT) { return 500; }"})
    {
        warnings.clear();
        server->start(refusal);
        Cache refused = open(server->url());
        put(refused, std::string(5 << 20, 'x'));
        put(refused, std::string(2000, 'y'));
        refused.putEntry(computeSha256("other"), kEntry);
        expectWarning("nothing more is put there");
        EXPECT_FALSE(refused.isWritable());
        EXPECT_EQ(refused.entry(kKey), kEntry);
        EXPECT_FALSE(fs::exists(server->store() + "/ac/" + computeSha256("other")));
    }
}

TEST_F(NginxTest, aServerThatWasRestartedIsFoundAgain)
{
    Cache cache = open(server->url());
    cache.putEntry(kKey, kEntry);
    server->start("");
    EXPECT_EQ(cache.entry(kKey), kEntry) << "its connection had been closed";
    server->start("");
    const std::string hash = put(cache, std::string(3 << 20, 'x'));
    EXPECT_TRUE(fs::exists(server->store() + "/cas/" + hash));
    EXPECT_EQ(warnings, std::vector<std::string>{});
}

TEST_F(NginxTest, aServerThatDripsIsGivenUp)
{
    {
        Cache cache = open(server->url());
        put(cache, std::string(100000, 'x'));
    }
    server->start("limit_rate 1000;");
    Cache cache = open(server->url(), kShort);
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(get(cache, computeSha256(std::string(100000, 'x'))), "nothing");
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
    expectWarning("is too slow to be of use");
}

TEST_F(HttpTest, aServerThatIsNotThereIsToldOfOnce)
{
    Cache cache = open("http://me:secret@127.0.0.1:" + std::to_string(test::freePort()) + "/x");
    EXPECT_EQ(cache.entry(kKey), std::nullopt);
    cache.putEntry(kKey, kEntry);
    put(cache, "some bytes");
    EXPECT_EQ(get(cache, computeSha256("some bytes")), "nothing");
    expectWarning("http://127.0.0.1:");
    EXPECT_EQ(warnings[0].find("secret"), std::string::npos) << warnings[0];
}

TEST_F(HttpTest, aServerThatIsSilentIsGivenUp)
{
    const test::SilentServer silent;
    for (int write = 0; write < 2; ++write)
    {
        warnings.clear();
        Cache cache = open(silent.url(), kShort);
        if (write == 1)
            put(cache, std::string(1 << 20, 'x'));
        EXPECT_EQ(cache.entry(kKey), std::nullopt);
        expectWarning("is too slow to be of use");
    }
}

TEST_F(HttpTest, brokenAnswersAreErrorsAndLeaveNoFile)
{
    const std::string whole = entryAnswer("some bytes");
    const std::string hash = computeSha256("some bytes");
    {
        const test::FixedServer server(whole);
        Cache cache = open(server.url());
        EXPECT_EQ(get(cache, hash), "some bytes");
        EXPECT_EQ(warnings, std::vector<std::string>{});
    }
    std::vector<std::string> broken{"garbage\r\n\r\n", "HTTP/1.1 200 OK\r\nContent-Length: -1\r\n\r\n"};
    for (size_t size = 0; size < whole.size(); ++size)
        broken.push_back(whole.substr(0, size));
    for (const std::string& answer : broken)
    {
        warnings.clear();
        const test::FixedServer server(answer);
        Cache cache = open(server.url());
        EXPECT_EQ(get(cache, hash), "nothing") << answer;
        EXPECT_EQ(warnings.size(), 1u) << answer;
    }
}

TEST_F(HttpTest, otherAnswersAreErrors)
{
    for (const char* status : {"301 Moved\r\nLocation: http://127.0.0.1:1/", "401 Who", "403 No", "500 Oh",
                               "503 Busy", "206 Part"})
    {
        warnings.clear();
        const test::FixedServer server(std::string("HTTP/1.1 ") + status +
                                       "\r\nContent-Length: 2\r\nConnection: close\r\n\r\nno");
        Cache cache = open(server.url());
        EXPECT_EQ(cache.entry(kKey), std::nullopt);
        expectWarning("|/ac/" + kKey + ": warning: the server answers with status " +
                      std::string(status).substr(0, 3));
    }
    warnings.clear();
    const test::FixedServer gone("HTTP/1.1 410 Gone\r\nContent-Length: 0\r\nConnection: close\r\n\r\n");
    Cache cache = open(gone.url());
    EXPECT_EQ(cache.entry(kKey), std::nullopt);
    EXPECT_EQ(warnings, std::vector<std::string>{});
}

TEST_F(HttpTest, aPageWithoutEndIsCutOff)
{
    const test::FixedServer server("HTTP/1.1 404 No\r\nConnection: close\r\n\r\n" +
                                   std::string(1 << 20, 'x'));
    Cache cache = open(server.url());
    EXPECT_EQ(cache.entry(kKey), std::nullopt);
    EXPECT_EQ(warnings, std::vector<std::string>{}) << "it is not there, whatever else is said";
}

TEST_F(HttpTest, aSignalThatWaitsEndsTheWaiting)
{
    sigset_t signals;
    sigset_t before;
    ::sigemptyset(&signals);
    ::sigaddset(&signals, SIGTERM);
    ::sigprocmask(SIG_BLOCK, &signals, &before);
    ::raise(SIGTERM);
    const test::SilentServer silent;
    Cache cache = open(silent.url());
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(cache.entry(kKey), std::nullopt);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(3));
    expectWarning("a signal ends the cook");
    const timespec none = {};
    ::sigtimedwait(&signals, nullptr, &none);
    ::sigprocmask(SIG_SETMASK, &before, nullptr);
}

} // namespace hearth::cache
