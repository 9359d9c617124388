#include <Eigen/Core>
#include <cholmod.h>
#include <iostream>

int main() {
  cholmod_common common;
  const bool started = cholmod_l_start(&common) != 0;
  cholmod_l_finish(&common);
  std::cout << "Eigen " << EIGEN_WORLD_VERSION << '.' << EIGEN_MAJOR_VERSION << ", CHOLMOD "
            << CHOLMOD_MAIN_VERSION << '.' << CHOLMOD_SUB_VERSION << '\n';
  return started ? 0 : 1;
}
