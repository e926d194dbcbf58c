// SPDX-License-Identifier: GPL-3.0-or-later
// ranks_nccl.cpp  Connects processes started by MPI. Their devices send each other messages by NCCL.
#include <mpi.h>
#include <nccl.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "macadam/error.hpp"
#include "macadam/ranks.hpp"

namespace macadam::kernels {
namespace {

/// \throws RunError with MPI's message if `status` is an error.
void check_mpi(int status, const char* what) {
  if (status == MPI_SUCCESS) return;
  char text[MPI_MAX_ERROR_STRING] = "";
  int size = 0;
  MPI_Error_string(status, text, &size);
  throw RunError(std::string("MPI: ") + what + ": " + text);
}

/// Ranks by MPI, with device messages by NCCL.
class NcclRanks final : public Ranks {
 public:
  NcclRanks() {
    int begun = 0, given = 0;
    MPI_Initialized(&begun);  // a library that has started MPI, such as mpi4py, also ends it
    began_ = !begun;
    if (began_) check_mpi(MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &given), "start");
    // A communicator of its own separates these messages from other messages of the program
    check_mpi(MPI_Comm_dup(MPI_COMM_WORLD, &all_), "ranks");
    MPI_Comm_set_errhandler(all_, MPI_ERRORS_RETURN);
    MPI_Comm on_host = MPI_COMM_NULL;
    check_mpi(MPI_Comm_rank(all_, &number_), "rank");
    check_mpi(MPI_Comm_size(all_, &count_), "ranks");
    check_mpi(MPI_Comm_split_type(all_, MPI_COMM_TYPE_SHARED, number_, MPI_INFO_NULL, &on_host), "hosts");
    check_mpi(MPI_Comm_rank(on_host, &number_on_host_), "hosts");
    check_mpi(MPI_Comm_size(on_host, &count_on_host_), "hosts");
    MPI_Comm_free(&on_host);
  }

  int number() const override { return number_; }
  int count() const override { return count_; }
  int number_on_host() const override { return number_on_host_; }
  int count_on_host() const override { return count_on_host_; }

  void take_of_first(void* data, std::size_t size) override {
    constexpr std::size_t most = std::size_t{1} << 30;  // MPI counts in int
    for (std::size_t done = 0; done < size; done += most) {
      const auto part = static_cast<int>(std::min(most, size - done));
      check_mpi(MPI_Bcast(static_cast<char*>(data) + done, part, MPI_BYTE, 0, all_), "broadcast");
    }
  }
  double least(double value) override {
    double out = value;
    check_mpi(MPI_Allreduce(&value, &out, 1, MPI_DOUBLE, MPI_MIN, all_), "least");
    return out;
  }

  void connect(int device) override {
    if (device == device_) return;
    if (link_) {
      throw RunError("ranks: rank " + std::to_string(number_) + ": found device " + std::to_string(device) +
                     ", expected device " + std::to_string(device_) + ", because this rank reported device " +
                     std::to_string(device_) + " to the other ranks");
    }
    ncclUniqueId id{};
    if (number_ == 0) check(ncclGetUniqueId(&id), "start");
    take_of_first(&id, sizeof id);
    check(ncclCommInitRank(&link_, count_, id, number_), ("device " + std::to_string(device)).c_str());
    device_ = device;
  }
  void queue(const std::vector<Message>& sent, const std::vector<Message>& received, void* stream) override {
    const auto to = static_cast<cudaStream_t>(stream);
    check(ncclGroupStart(), "messages");
    for (const Message& m : sent) check(ncclSend(m.data, m.size, ncclInt8, m.rank, link_, to), "message");
    for (const Message& m : received) check(ncclRecv(m.data, m.size, ncclInt8, m.rank, link_, to), "message");
    check(ncclGroupEnd(), "messages");
  }
  void require_link() override {
    if (!link_) return;
    ncclResult_t found = ncclSuccess;
    check(ncclCommGetAsyncError(link_, &found), "messages");
    if (found != ncclInProgress) check(found, "messages");
  }
  bool goes_into_graphs() const override { return true; }

  void leave() override {
    if (began_) MPI_Finalize();
  }
  void end_all(int code) override {
    MPI_Abort(all_, code);
    std::_Exit(code);
  }

 private:
  void check(ncclResult_t status, const char* what) const {
    if (status == ncclSuccess) return;
    throw RunError("NCCL: rank " + std::to_string(number_) + ": " + what + ": " + ncclGetErrorString(status) + ": " +
                   ncclGetLastError(nullptr));
  }

  MPI_Comm all_ = MPI_COMM_NULL;
  bool began_ = false;
  int number_ = 0, count_ = 1, number_on_host_ = 0, count_on_host_ = 1, device_ = -1;
  ncclComm_t link_ = nullptr;
};

/// Joins the processes; always returns the same object.
Ranks* join() {
  // Never deleted, because at the end of the program the CUDA driver may end before the NCCL communicator
  static NcclRanks* const joined = new NcclRanks;
  return joined;
}

}  // namespace

extern "C" {
extern const RanksPlugin macadam_ranks_plugin;
const RanksPlugin macadam_ranks_plugin{ranks_interface, MACADAM_VERSION, join};
}

}  // namespace macadam::kernels
