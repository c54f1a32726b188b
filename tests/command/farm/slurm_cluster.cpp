// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/command/farm/slurm_cluster.h"

#include "formats/base/assert.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <netinet/in.h>
#include <pwd.h>
#include <sstream>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace hearth::test
{

namespace
{

namespace fs = std::filesystem;

/// Return the path of a program; empty if it is not installed.
std::string programPath(const std::string& name)
{
    for (const char* folder : {"/usr/sbin/", "/usr/bin/", "/usr/local/sbin/", "/usr/local/bin/"})
        if (::access((folder + name).c_str(), X_OK) == 0)
            return folder + name;
    return "";
}

/// Return unused ports; another process may still take one first.
std::vector<int> freePorts(int count)
{
    std::vector<int> ports;
    std::vector<int> sockets;
    for (int i = 0; i < count; ++i)
    {
        sockets.push_back(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof(address);
        auto* any = reinterpret_cast<sockaddr*>(&address);
        HEARTH_ASSERT(::bind(sockets.back(), any, sizeof(address)) == 0);
        HEARTH_ASSERT(::getsockname(sockets.back(), any, &size) == 0);
        ports.push_back(ntohs(address.sin_port));
    }
    for (const int socket : sockets)
        ::close(socket);
    return ports;
}

std::string readAll(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

std::string hostName()
{
    char name[256] = {};
    HEARTH_ASSERT(::gethostname(name, sizeof(name) - 1) == 0);
    const std::string whole = name;
    return whole.substr(0, whole.find('.'));
}

/// Return the processes whose environment has a variable of this value.
std::vector<pid_t> processesWith(const std::vector<std::string>& variables)
{
    std::vector<pid_t> processes;
    std::error_code error;
    for (auto at = fs::directory_iterator("/proc", error); !error && at != fs::directory_iterator();
         at.increment(error))
    {
        const pid_t process = std::atoi(at->path().filename().c_str());
        if (process <= 0 || process == ::getpid())
            continue;
        const std::string environment = '\0' + readAll(at->path() / "environ");
        const auto has = [&](const std::string& variable)
        { return environment.find('\0' + variable + '\0') != std::string::npos; };
        if (std::all_of(variables.begin(), variables.end(), has))
            processes.push_back(process);
    }
    return processes;
}

/// Return the slurmstepd that a job's process runs under; 0 if there is none.
pid_t findStep(pid_t process)
{
    for (int generation = 0; process > 1 && generation < 16; ++generation)
    {
        std::istringstream status(readAll("/proc/" + std::to_string(process) + "/status"));
        std::string name;
        pid_t parent = 0;
        for (std::string line; std::getline(status, line);)
            if (line.starts_with("Name:\t"))
                name = line.substr(6);
            else if (line.starts_with("PPid:\t"))
                parent = std::atoi(line.c_str() + 6);
        if (name == "slurmstepd")
            return process;
        process = parent;
    }
    return 0;
}

} // namespace

std::string SlurmCluster::whyNot()
{
    for (const char* program :
         {"munged", "slurmctld", "slurmd", "sbatch", "srun", "squeue", "sinfo", "scontrol"})
        if (programPath(program).empty())
            return std::string(program) + " is not installed: apt-get install slurm-wlm munge";
    return "";
}

SlurmCluster::SlurmCluster(Sandbox& folder, int node_count) : folder_(folder), path_(folder / "slurm")
{
    fs::create_directories(path_ + "/state");
    // munged requires a key and folders that nobody else can write or read
    fs::permissions(path_, fs::perms(0755));
    fs::permissions(folder.path(), fs::perms(0755));
    folder_.write("slurm/munge.key", std::string(1024, 'k'));
    fs::permissions(path_ + "/munge.key", fs::perms(0600));
    writeConfiguration(node_count);
    startDaemon("munged",
                {programPath("munged"), "--foreground", "--force", "--key-file=" + path_ + "/munge.key",
                 "--socket=" + path_ + "/munge.socket", "--pid-file=" + path_ + "/munged.pid",
                 "--log-file=" + path_ + "/munged.own.log", "--seed-file=" + path_ + "/munge.seed"});
    for (int tries = 0; tries < 100 && !fs::exists(path_ + "/munge.socket"); ++tries)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    const std::string configuration = path_ + "/slurm.conf";
    startDaemon("slurmctld", {programPath("slurmctld"), "-D", "-f", configuration});
    for (int node = 1; node <= node_count; ++node)
        startDaemon("w" + std::to_string(node),
                    {programPath("slurmd"), "-D", "-f", configuration, "-N", "w" + std::to_string(node)});
}

SlurmCluster::~SlurmCluster()
{
    for (const std::string& signal : {std::string("TERM"), std::string("KILL")})
    {
        // jobs and their steps inherit this too: it is their configuration of the cluster
        for (const pid_t process : processesWith({"SLURM_CONF=" + path_ + "/slurm.conf"}))
        {
            if (const pid_t step = findStep(process); step != 0)
                ::kill(step, SIGKILL);
            ::kill(process, SIGKILL);
        }
        for (auto daemon = daemons_.rbegin(); daemon != daemons_.rend(); ++daemon)
            end(*daemon, signal == "TERM" ? SIGTERM : SIGKILL);
    }
}

void SlurmCluster::writeConfiguration(int node_count)
{
    const std::string host = hostName();
    const passwd* user = ::getpwuid(::geteuid());
    HEARTH_ASSERT(user != nullptr);
    const std::vector<int> ports = freePorts(node_count + 1);
    std::ostringstream text;
    text << "ClusterName=hearth\nSlurmctldHost=" << host << "(127.0.0.1)\nSlurmUser=" << user->pw_name
         << "\nSlurmdUser=" << user->pw_name << "\nSlurmctldPort=" << ports[0]
         << "\nAuthType=auth/munge\nAuthInfo=socket=" << path_
         << "/munge.socket,cred_expire=5\nCredType=cred/"
            "munge\nReturnToService=2\nSlurmdTimeout=10\nKillWait=2\n"
            "JobRequeue=1\nMpiDefault=none\nProctrackType=proctrack/linuxproc\nTaskPlugin=task/none\n"
            "JobAcctGatherType=jobacct_gather/none\nSelectType=select/cons_tres\n"
            "SelectTypeParameters=CR_Core_Memory\nSlurmdParameters=config_overrides\n"
            "JobCompType=jobcomp/"
            "none\nMinJobAge=600\nSchedulerParameters=sched_interval=2,bf_interval=2\nStateSaveLocation="
         << path_ << "/state\nSlurmdSpoolDir=" << path_ << "/spool.%n\nSlurmctldPidFile=" << path_
         << "/slurmctld.pid\nSlurmdPidFile=" << path_ << "/slurmd.%n.pid\n";
    for (int node = 1; node <= node_count; ++node)
        text << "NodeName=w" << node << " NodeHostname=" << host
             << " NodeAddr=127.0.0.1 Port=" << ports[size_t(node)] << " CPUs=1 RealMemory=4000\n";
    text << "PartitionName=cook Nodes=w[1-" << node_count << "] Default=YES MaxTime=INFINITE State=UP\n";
    folder_.write("slurm/slurm.conf", text.str());
}

void SlurmCluster::startDaemon(const std::string& name, std::vector<std::string> command)
{
    const std::string log = path_ + "/" + name + ".log";
    const std::string configuration = path_ + "/slurm.conf";
    const pid_t process = ::fork();
    HEARTH_ASSERT(process >= 0);
    if (process != 0)
    {
        daemons_.push_back({name, process});
        return;
    }
    // a crashing test leaves no daemon behind
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::setenv("SLURM_CONF", configuration.c_str(), 1);
    const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::dup2(file, STDOUT_FILENO);
    ::dup2(file, STDERR_FILENO);
    std::vector<char*> arguments;
    for (std::string& argument : command)
        arguments.push_back(argument.data());
    arguments.push_back(nullptr);
    ::execv(arguments[0], arguments.data());
    ::_exit(127);
}

void SlurmCluster::end(Daemon& daemon, int signal)
{
    if (daemon.process == 0)
        return;
    ::kill(daemon.process, signal);
    for (int tries = 0; tries < 60; ++tries)
    {
        if (::waitpid(daemon.process, nullptr, WNOHANG) != 0)
        {
            daemon.process = 0;
            return;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
}

std::vector<std::string> SlurmCluster::environment() const
{
    return {"SLURM_CONF=" + path_ + "/slurm.conf"};
}

ProgramEnd SlurmCluster::run(const std::vector<std::string>& command)
{
    std::vector<std::string> whole = command;
    whole[0] = programPath(command[0]);
    return folder_.run(whole, environment());
}

bool SlurmCluster::waitForIdle(int count, int seconds)
{
    for (int tries = 0; tries < seconds * 4; ++tries)
    {
        if (countOccurrences(run({"sinfo", "-h", "-N", "-o", "%t;"}).out, "idle;") >=
            static_cast<size_t>(count))
            return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(250));
    }
    return false;
}

std::string SlurmCluster::getState(const std::string& job)
{
    return run({"squeue", "-h", "-r", "-j", job, "-o", "%t %N"}).out;
}

size_t SlurmCluster::killNode(const std::string& node)
{
    for (Daemon& daemon : daemons_)
        if (daemon.name == node)
            end(daemon, SIGKILL);
    const std::vector<pid_t> processes =
        processesWith({"SLURM_CONF=" + path_ + "/slurm.conf", "SLURMD_NODENAME=" + node});
    std::vector<pid_t> steps;
    for (const pid_t process : processes)
        if (const pid_t step = findStep(process); step != 0)
            steps.push_back(step);
    // kill the step first: it would report the end of its job to the controller
    for (const pid_t step : steps)
        ::kill(step, SIGKILL);
    for (const pid_t process : processes)
        ::kill(process, SIGKILL);
    return processes.size();
}

std::string SlurmCluster::logs() const
{
    std::string text;
    for (const Daemon& daemon : daemons_)
    {
        const std::string log = readAll(path_ + "/" + daemon.name + ".log");
        text += "---- " + daemon.name + "\n" + log.substr(log.size() - std::min<size_t>(log.size(), 3000));
    }
    return text + readAll(path_ + "/munged.own.log");
}

} // namespace hearth::test
