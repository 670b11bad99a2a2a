// SPDX-License-Identifier: BSD-3-Clause
// Tracks a folder in the layout of the TUM RGB-D benchmark and writes the trajectory.
//   1_track_folder FOLDER TRAJECTORY
#include <mivo/core/error.h>
#include <mivo/core/odometry.h>
#include <mivo/io/sequence_reader.h>
#include <mivo/io/trajectory_io.h>

#include <iostream>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: 1_track_folder FOLDER TRAJECTORY\n";
    return 2;
  }
  try {
    mivo::SequenceReader reader(argv[1]);
    mivo::TrajectoryWriter writer(argv[2], mivo::Overwrite::kYes);
    mivo::Parameters parameters;
    setParameter(parameters, "method", "hybrid");  // doc/parameters.md has them all
    mivo::Odometry odometry(reader.camera(), parameters);

    mivo::Frame frame;
    mivo::FrameFault fault;
    int poses = 0;
    while (true) {
      const mivo::FrameSource::Status status = reader.next(frame, fault);
      if (status == mivo::FrameSource::Status::kEnd) break;
      if (status == mivo::FrameSource::Status::kSkipped) {
        std::cerr << "skipped: " << fault.text << "\n";
        continue;
      }
      // The pose of the color camera in the world, which is the first camera pose.
      const mivo::TrackingResult& result = odometry.process(frame);
      if (!result.isMeasured()) continue;
      writer.write({result.stamp, result.T_odom_camera});
      ++poses;
    }
    std::cout << poses << " of " << reader.size() << " frames tracked\n";
  } catch (const mivo::Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
