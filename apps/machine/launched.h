#pragma once
// Whether an MPI launcher has started this process, and with how many others.

namespace kaustik::app {

struct Launched {
  int ranks = 0;       // processes of the render; 0: started without a launcher
  int on_machine = 1;  // of them on this machine
};

// By the environment of mpirun (Open MPI), srun with PMIx or PMI, and mpiexec (MPICH): what is not an MPI job
// need not load MPI.
Launched launched();

}  // namespace kaustik::app
