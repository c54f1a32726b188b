// nginx as a team would run it for a cache, on a port of its own; and a server that says what it is told to.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>
#include <sys/types.h>
#include <thread>
#include <vector>

namespace hearth::test
{

/// A port of the loopback that nobody listens on.
int freePort();

/// Keeps what is PUT to ac/ and cas/ in a folder, and hands it out.
class WebServer
{
public:
    static bool isInstalled();

    /// folder      for its files; it is there
    /// directives  of nginx, for its only location
    explicit WebServer(std::string folder, const std::string& directives = "");
    ~WebServer() { stop(); }
    WebServer(const WebServer&) = delete;
    WebServer& operator=(const WebServer&) = delete;

    std::string url() const { return "http://127.0.0.1:" + std::to_string(port_); }
    /// Where what is PUT lies.
    std::string store() const { return folder_ + "/store"; }

    /// tls  directives that name its certificate, where it speaks TLS
    void start(const std::string& directives, const std::string& tls = "");
    void stop();

    /// Stops it, so that all is written: "GET /ac/KEY 200", a line a request, in the order of their ends; of all starts.
    std::vector<std::string> log();

private:
    std::string folder_;
    int port_;
    pid_t process_ = 0;
};

/// Answers every connection with the same bytes, and closes it.
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

/// Takes connections, and never says anything.
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
