// Test servers for caches: nginx, configured as for a team's cache, on its own port; and servers with fixed
// or no answers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>
#include <sys/types.h>
#include <thread>
#include <vector>

namespace hearth::test
{

/// Return a port of the loopback interface that nothing listens on.
int freePort();

/// Stores files that are PUT to ac/ and cas/ in a folder, and serves them.
class WebServer
{
public:
    static bool isInstalled();

    /// folder      existing folder for its files
    /// directives  nginx directives for its only location
    explicit WebServer(std::string folder, const std::string& directives = "");
    ~WebServer() { stop(); }
    WebServer(const WebServer&) = delete;
    WebServer& operator=(const WebServer&) = delete;

    std::string url() const { return "http://127.0.0.1:" + std::to_string(port_); }
    /// Return the folder that PUT requests write to.
    std::string store() const { return folder_ + "/store"; }

    /// tls  directives that name its certificate, if it uses TLS
    void start(const std::string& directives, const std::string& tls = "");
    void stop();

    /// Stop the server to flush its log, and return the log of all starts: one line per request, "GET /ac/KEY
    /// 200", in the order of completion.
    std::vector<std::string> log();

private:
    std::string folder_;
    int port_;
    pid_t process_ = 0;
};

/// Sends the same bytes to every connection and closes it.
class FixedServer
{
public:
    explicit FixedServer(std::string answer);
    ~FixedServer();
    FixedServer(const FixedServer&) = delete;
    FixedServer& operator=(const FixedServer&) = delete;

    std::string url() const { return "http://127.0.0.1:" + std::to_string(port_); }

private:
    void serve();

    std::string answer_;
    int port_ = 0; ///< before the socket, which sets it
    int socket_;
    std::thread thread_;
};

/// Accepts connections, but never answers.
class SilentServer
{
public:
    SilentServer();
    ~SilentServer();
    SilentServer(const SilentServer&) = delete;
    SilentServer& operator=(const SilentServer&) = delete;

    std::string url() const { return "http://127.0.0.1:" + std::to_string(port_); }

private:
    int port_ = 0; ///< before the socket, which sets it
    int socket_;
};

} // namespace hearth::test
