// Tests cooks that share results through nginx, with the real cookers: server failures cost time, but never
// change the pack.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/sandbox.h"
#include "tests/support/small_sources.h"
#include "tests/support/web_server.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

namespace fs = std::filesystem;

/// Make a clean checkout of the same two sources.
class Checkout
{
public:
    Checkout()
    {
        writeObj(folder, "house");
        writeGltf(folder, "tree");
    }

    ProgramEnd cook(const std::vector<std::string>& caches)
    {
        std::vector<std::string> command{HEARTH_BIN "/hearth", "cook", "house.obj",
                                         "tree.gltf",          "-o",   "a.hearth"};
        for (const std::string& cache : caches)
            command.insert(command.end(), {"--cache", cache});
        return folder.run(command, {"no_proxy=127.0.0.1", "HEARTH_LOG=verbose"});
    }
    /// Cook with a local cache folder in front of the server.
    ProgramEnd cookWith(const std::string& server) { return cook({near(), server}); }

    std::string near() const { return "dir:" + folder.cachePath(); }
    std::string pack() const { return folder.read("a.hearth"); }

    Sandbox folder;
};

constexpr size_t kActions = 11;

size_t ranIn(const ProgramEnd& end)
{
    size_t count = 0;
    for (const char* cooker : {"import", "textures", "texels", "clusters", "skinning", "link"})
        count += countOccurrences("\n" + end.err, std::string("\n") + cooker + " ");
    return count;
}

class ServerCache : public ::testing::Test
{
protected:
    void SetUp() override
    {
        if (!WebServer::isInstalled())
            GTEST_SKIP() << "nginx is not installed (Debian's nginx-light)";
        server = std::make_unique<WebServer>(server_folder.path());
        const ProgramEnd end = first.cookWith(server->url());
        ASSERT_EQ(end.exit_code, 0) << end.err;
        ASSERT_EQ(ranIn(end), kActions) << end.err;
        ASSERT_EQ(countOccurrences(end.err, "W4100"), 0u) << end.err;
    }

    /// Check that the cook succeeds, makes the same pack, and prints this many warnings about the server.
    void expectSame(Checkout& checkout, const ProgramEnd& end, size_t ran, size_t warnings,
                    const std::string& what) const
    {
        EXPECT_EQ(end.exit_code, 0) << end.err;
        EXPECT_EQ(ranIn(end), ran) << end.err;
        EXPECT_EQ(countOccurrences(end.err, "W4100"), warnings) << end.err;
        EXPECT_NE(end.err.find(what), std::string::npos) << end.err;
        EXPECT_EQ(checkout.pack(), first.pack());
    }

    void overwriteAll(const std::string& kind, const std::string& content) const
    {
        for (const auto& file : fs::directory_iterator(server->store() + "/" + kind))
            std::ofstream(file.path(), std::ios::binary) << content;
    }

    Sandbox server_folder;
    std::unique_ptr<WebServer> server;
    Checkout first;
};

} // namespace

TEST_F(ServerCache, aCleanCheckoutCooksNothing)
{
    Checkout second;
    expectSame(second, second.cookWith(server->url() + ",ro"), 0, 0, "cooked");
    Checkout without_folder;
    expectSame(without_folder, without_folder.cook({server->url()}), 0, 0, "cooked");
}

TEST_F(ServerCache, isAskedForNothingThatIsNear)
{
    const size_t before = server->log().size();
    server->start("");
    expectSame(first, first.cookWith(server->url()), 0, 0, "up to date");
    fs::remove(first.folder / "a.hearth");
    expectSame(first, first.cookWith(server->url()), 0, 0, "cooked");
    EXPECT_EQ(server->log().size(), before);
    EXPECT_GT(before, kActions);
}

TEST_F(ServerCache, aChangeCooksWhatReadItAndFetchesTheRest)
{
    Checkout second;
    second.folder.write("house.tga", tgaImage(7));
    const ProgramEnd end = second.cookWith(server->url());
    EXPECT_EQ(ranIn(end), 6u) << end.err;
    EXPECT_EQ(countOccurrences(end.err, "tree.gltf\n"), 0u) << end.err;
    Checkout third;
    third.folder.write("house.tga", tgaImage(7));
    EXPECT_EQ(ranIn(third.cookWith(server->url())), 0u);
    EXPECT_EQ(third.pack(), second.pack());
    Checkout fourth;
    expectSame(fourth, fourth.cookWith(server->url()), 0, 0, "cooked");
}

TEST_F(ServerCache, stopped)
{
    server->stop();
    Checkout second;
    expectSame(second, second.cookWith(server->url()), kActions, 1, "connect");
    expectSame(second, second.cookWith(server->url()), 0, 0, "up to date");
}

TEST_F(ServerCache, slow)
{
    server->start("limit_rate 20;");
    Checkout second;
    const auto start = std::chrono::steady_clock::now();
    expectSame(second, second.cookWith(server->url()), kActions, 1, "is too slow to be of use");
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
}

TEST_F(ServerCache, full)
{
    for (const char* refusal : {"client_max_body_size 1k;", "if ($request_method = PUT) { return 507; }"})
    {
        server->start(refusal);
        Checkout second;
        second.folder.write("house.tga", tgaImage(9));
        const ProgramEnd end = second.cookWith(server->url());
        EXPECT_EQ(end.exit_code, 0) << end.err;
        EXPECT_EQ(ranIn(end), 6u) << "what is there is still taken: " << end.err;
        EXPECT_EQ(countOccurrences(end.err, "W4100"), 1u) << end.err;
        EXPECT_NE(end.err.find("nothing more is put there"), std::string::npos) << end.err;
    }
}

TEST_F(ServerCache, garbageForContents)
{
    overwriteAll("cas", "garbage");
    Checkout second;
    // the entries are valid: only the pack is fetched, and linked again from parts, even though these are
    // garbage
    const ProgramEnd end = second.cookWith(server->url());
    EXPECT_GE(countOccurrences(end.err, "is damaged"), 1u);
    expectSame(second, end, ranIn(end), countOccurrences(end.err, "is damaged"),
               "is damaged: it is made again");
    // the new results have repaired the server
    Checkout third;
    expectSame(third, third.cookWith(server->url()), 0, 0, "cooked");
}

TEST_F(ServerCache, garbageForEntries)
{
    overwriteAll("ac", "hearth.entry/1 torn");
    Checkout second;
    const ProgramEnd end = second.cookWith(server->url());
    expectSame(second, end, kActions, countOccurrences(end.err, "is damaged"), "is damaged");
    Checkout third;
    expectSame(third, third.cookWith(server->url()), 0, 0, "cooked");
}

TEST_F(ServerCache, overTlsOnlyWhomTheMachineTrusts)
{
    const std::string key = server_folder / "key.pem";
    const std::string certificate = server_folder / "certificate.pem";
    if (server_folder
            .run({"/usr/bin/openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256",
                  "-nodes", "-keyout", key, "-out", certificate, "-days", "2", "-subj", "/CN=127.0.0.1",
                  "-addext", "subjectAltName=IP:127.0.0.1"})
            .exit_code != 0)
        GTEST_SKIP() << "openssl is not installed";
    server->start("", "ssl_certificate " + certificate + "; ssl_certificate_key " + key + ";");
    const std::string url = "https" + server->url().substr(4);
    Checkout second;
    expectSame(second, second.cookWith(url), kActions, 1, "certificate");

    // in its own mount namespace, the machine trusts only this certificate
    const std::string trusting = "mount --bind " + certificate + " /etc/ssl/certs/ca-certificates.crt && ";
    const auto inOwnView = [&](Checkout& checkout, const std::string& command)
    {
        return checkout.folder.run({"/usr/bin/unshare", "-rm", "/bin/sh", "-c", trusting + command},
                                   {"no_proxy=127.0.0.1", "HEARTH_LOG=verbose"});
    };
    Checkout third;
    if (inOwnView(third, "true").exit_code != 0)
        GTEST_SKIP() << "this machine allows no view of the file system of one's own";
    expectSame(third,
               inOwnView(third, HEARTH_BIN "/hearth cook house.obj tree.gltf -o a.hearth --cache " + url), 0,
               0, "cooked");
}

TEST_F(ServerCache, theVerbsOfTheCacheNameIt)
{
    const std::string url = "http://me:secret@127.0.0.1:1/team";
    for (const char* work : {"stat", "gc", "verify"})
    {
        const ProgramEnd end = first.folder.run({HEARTH_BIN "/hearth", "cache", work, "--cache", url});
        EXPECT_EQ(end.exit_code, 0) << end.err;
        EXPECT_EQ(end.out, "http://127.0.0.1:1/team: a server, which looks after itself\n");
    }
}

} // namespace hearth::test
