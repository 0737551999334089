// The program globular-mpi: the command simulate, computed by all processes that mpirun has started.
#include <fmt/format.h>
#include <mpi.h>
#include <zoltan.h>

#include <csignal>
#include <string>

#include "mpi/rank_host.h"
#include "tools/commands/commands.h"

namespace {

/// What --version prints.
std::string versionText() {
    std::string library(MPI_MAX_LIBRARY_VERSION_STRING, '\0');
    int length = 0;
    MPI_Get_library_version(library.data(), &length);
    library.resize(static_cast<std::size_t>(length));
    return fmt::format("globular-mpi " GLOBULAR_VERSION "\nwith {}, Zoltan {}",
                       library.substr(0, library.find_first_of(",\n")), ZOLTAN_VERSION_NUMBER);
}

/// Runs the command on rank 0.
int runOnFirst(mpi::MpiRanks& ranks, int argc, char** argv) {
    mpi::RankHost host(ranks, {});
    CLI::App program("simulates a scene on all processes that mpirun starts", "globular-mpi");
    program.require_subcommand(0, 1);
    program.set_version_flag("--version", versionText, "print the version, and those of MPI and Zoltan");
    program.footer("Example: mpirun -np 4 globular-mpi simulate liquid -o out/liquid-states");
    tools::addSimulateCommand(program, &host);
    program.get_subcommand("simulate")
        ->add_flag("!--no-balance", host.options().isBalanced,
                   "keep the first division of space, wherever the particles go");
    return tools::runProgram(program, argc, argv);
}

/// Does what rank 0 orders.
int runOnOther(mpi::MpiRanks& ranks) {
    // Ctrl-C is for rank 0, which ends the run in order.
    std::signal(SIGINT, SIG_IGN);
    std::signal(SIGTERM, SIG_IGN);
    mpi::serve(ranks);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    int exitCode = 0;
    {
        mpi::MpiRanks ranks(MPI_COMM_WORLD);
        tools::prepareProcess();
        exitCode = ranks.own() == 0 ? runOnFirst(ranks, argc, argv) : runOnOther(ranks);
    }
    MPI_Finalize();
    return exitCode;
}
