#include "app/cluster/ranks.h"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>

#include "scene/messages/error.h"

namespace clues::app {

std::unique_ptr<Ranks> joined_ranks() {
  // Set by Open MPI's mpirun, and by Slurm's srun --mpi=pmix.
  if (!std::getenv("OMPI_COMM_WORLD_SIZE") && !std::getenv("PMIX_RANK")) return nullptr;
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  void* module = nullptr;
  // Parts of MPI, modules themselves, look for its names.
  for (const auto& folder : {program, program.parent_path() / CLUES_MODULE_FOLDER}) {
    if (!module) module = dlopen((folder / "clues_mpi.so").c_str(), RTLD_NOW | RTLD_GLOBAL);
  }
  const auto make = module ? reinterpret_cast<Ranks* (*)()>(dlsym(module, "clues_mpi_ranks")) : nullptr;
  if (!make) {
    const char* why = dlerror();
    throw scene::Error(scene::ErrorCode::unsupported,
                       std::string("started by mpirun, but without clues_mpi.so, which is built where Open MPI is "
                                   "installed (libopenmpi-dev); --shard needs none (") +
                           (why ? why : "not found") + ")");
  }
  return std::unique_ptr<Ranks>(make());
}

}  // namespace clues::app
