// SPDX-License-Identifier: BSD-3-Clause
#include "openni2/camera_thread.h"

#include <ctime>
#include <utility>

namespace mivo {
namespace {

constexpr double kSecondsPerNanosecond = 1e-9;

double threadTime() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) +
         static_cast<double>(time.tv_nsec) * kSecondsPerNanosecond;
}

}  // namespace

CameraThread::CameraThread(DeviceRequest request, SessionTimes times, DeviceFactory factory,
                           CameraSession::HostClock host_clock, CameraListener& listener)
    : session_(std::move(request), times, std::move(factory), std::move(host_clock), listener),
      thread_(&CameraThread::run, this) {}

CameraThread::~CameraThread() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void CameraThread::setDemand(const StreamDemand& demand) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    new_demand_ = demand;
  }
  wake_.notify_one();
}

void CameraThread::setSettings(const CameraSettings& settings) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    new_settings_ = settings;
  }
  wake_.notify_one();
}

CameraStatus CameraThread::status() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return status_;
}

void CameraThread::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!stop_) {
    if (new_demand_) {
      session_.setDemand(*new_demand_);
      new_demand_.reset();
    }
    if (new_settings_) {
      session_.setSettings(*new_settings_);
      new_settings_.reset();
    }
    lock.unlock();
    const auto pause = session_.step(std::chrono::steady_clock::now());
    CameraStatus status = session_.status();
    processor_time_ = threadTime();
    lock.lock();
    status_ = std::move(status);
    wake_.wait_for(lock, pause, [&] { return stop_ || new_demand_ || new_settings_; });
  }
}

}  // namespace mivo
