#include "vispline/io/rig_source.h"

#include "vispline/io/io_testing.h"
#include "vispline/io/rig_file.h"
#include "vispline/io/rig_presets.h"

namespace vispline {
namespace {

TEST(RigSource, OurOwnFileIsOneToo) {
  const ScratchFolder folder;
  RigDocument document = *rig_preset("phone");
  document.rig.imus[0].gyroscope.bias = Vector3d(0.01, 0.0, 0.0);
  document.rig.imus[0].noise.accel.walk = 0.0;
  write_rig(folder.path("rig.yaml"), document);
  const std::string json = folder.write("result.json", "{}");
  const CalibrationSource source = read_rig_source(json);
  EXPECT_EQ(source.reading.dialect, "vispline");
  EXPECT_EQ(source.paths, std::vector<std::string>{folder.path("rig.yaml")});
  ASSERT_EQ(source.notes.size(), 2u);
  EXPECT_EQ(source.notes[0], "imu0: a random walk of 0 is left out; set it by hand for tools that ask for one");
  EXPECT_EQ(source.notes[1], "imu0: its biases are lost");
  const CameraCalibration& camera = source.reading.rig.cameras.at(0);
  EXPECT_EQ(camera.line_delay, document.rig.cameras[0].shutter.line_delay_s);
  EXPECT_EQ(camera.timeshift_cam_imu, document.rig.cameras[0].time_offset_s);
  const ImuNoiseEntry& noise = source.reading.rig.imus.at(0).noise;
  EXPECT_EQ(noise.gyro_walk.value, document.rig.imus[0].noise.gyro.walk);
  EXPECT_FALSE(noise.accel_walk.value.has_value()) << "none: no number would be right";
  const std::string chain = folder.write("cams.yaml", rig_files("kalibr", source.reading.rig)[0].text);
  EXPECT_EQ(read_rig_source(chain).reading.dialect, "kalibr");
}

}  // namespace
}  // namespace vispline
