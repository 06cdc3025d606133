#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// The messages of ROS 2 that tools for looking on understand, as plain values. Facts, not code, are taken over from ROS 2: names, members,
/// their order and types. `kType` is what ROS 2 calls the type; `members(message, visit)` calls `visit(name, member)` for each member in
/// the order of the definition, which is the order on the wire. Lengths [m], angles [rad].
namespace interlace::ros2 {

/// Since the epoch, by the wall clock of the machine that writes.
struct Time {
  static constexpr const char* kType = "builtin_interfaces/msg/Time";
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;

  template <typename Self, typename Visit>
  static void members(Self& m, Visit&& visit) {
    visit("sec", m.sec);
    visit("nanosec", m.nanosec);
  }
};

struct Duration {
  static constexpr const char* kType = "builtin_interfaces/msg/Duration";
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;

  template <typename Self, typename Visit>
  static void members(Self& m, Visit&& visit) {
    visit("sec", m.sec);
    visit("nanosec", m.nanosec);
  }
};

struct Header {
  static constexpr const char* kType = "std_msgs/msg/Header";
  Time stamp;
  std::string frame_id;

  template <typename Self, typename Visit>
  static void members(Self& m, Visit&& visit) {
    visit("stamp", m.stamp);
    visit("frame_id", m.frame_id);
  }
};

struct String {
  static constexpr const char* kType = "std_msgs/msg/String";
  std::string data;

  template <typename Self, typename Visit>
  static void members(Self& m, Visit&& visit) {
    visit("data", m.data);
  }
};

/// 0 … 1 each.
struct ColorRGBA {
  static constexpr const char* kType = "std_msgs/msg/ColorRGBA";
  float r = 0, g = 0, b = 0, a = 0;

  template <typename Self, typename Visit>
  static void members(Self& m, Visit&& visit) {
    visit("r", m.r);
    visit("g", m.g);
    visit("b", m.b);
    visit("a", m.a);
  }
};

struct Point {
  static constexpr const char* kType = "geometry_msgs/msg/Point";
  double x = 0, y = 0, z = 0;

  template <typename Self, typename Visit>
  static void members(Self& m, Visit&& visit) {
    visit("x", m.x);
    visit("y", m.y);
    visit("z", m.z);
  }
};

struct Vector3 {
  static constexpr const char* kType = "geometry_msgs/msg/Vector3";
  double x = 0, y = 0, z = 0;

  template <typename Self, typename Visit>
  static void members(Self& m, Visit&& visit) {
    visit("x", m.x);
    visit("y", m.y);
    visit("z", m.z);
  }
};

struct Quaternion {
  static constexpr const char* kType = "geometry_msgs/msg/Quaternion";
  double x = 0, y = 0, z = 0, w = 1;

  template <typename Self, typename Visit>
  static void members(Self& m, Visit&& visit) {
    visit("x", m.x);
    visit("y", m.y);
    visit("z", m.z);
    visit("w", m.w);
  }
};

struct Pose {
  static constexpr const char* kType = "geometry_msgs/msg/Pose";
  Point position;
  Quaternion orientation;

  template <typename Self, typename Visit>
  static void members(Self& m, Visit&& visit) {
    visit("position", m.position);
    visit("orientation", m.orientation);
  }
};

struct Transform {
  static constexpr const char* kType = "geometry_msgs/msg/Transform";
  Vector3 translation;
  Quaternion rotation;

  template <typename Self, typename Visit>
  static void members(Self& m, Visit&& visit) {
    visit("translation", m.translation);
    visit("rotation", m.rotation);
  }
};

/// Pose of the child frame in the frame of the header.
struct TransformStamped {
  static constexpr const char* kType = "geometry_msgs/msg/TransformStamped";
  Header header;
  std::string child_frame_id;
  Transform transform;

  template <typename Self, typename Visit>
  static void members(Self& m, Visit&& visit) {
    visit("header", m.header);
    visit("child_frame_id", m.child_frame_id);
    visit("transform", m.transform);
  }
};

struct TFMessage {
  static constexpr const char* kType = "tf2_msgs/msg/TFMessage";
  std::vector<TransformStamped> transforms;

  template <typename Self, typename Visit>
  static void members(Self& m, Visit&& visit) {
    visit("transforms", m.transforms);
  }
};

/// `position` has a value for each name; what is not known stays empty.
struct JointState {
  static constexpr const char* kType = "sensor_msgs/msg/JointState";
  Header header;
  std::vector<std::string> name;
  std::vector<double> position, velocity, effort;  ///< [rad], [rad/s], [Nm]

  template <typename Self, typename Visit>
  static void members(Self& m, Visit&& visit) {
    visit("header", m.header);
    visit("name", m.name);
    visit("position", m.position);
    visit("velocity", m.velocity);
    visit("effort", m.effort);
  }
};

struct KeyValue {
  static constexpr const char* kType = "diagnostic_msgs/msg/KeyValue";
  std::string key, value;

  template <typename Self, typename Visit>
  static void members(Self& m, Visit&& visit) {
    visit("key", m.key);
    visit("value", m.value);
  }
};

struct DiagnosticStatus {
  static constexpr const char* kType = "diagnostic_msgs/msg/DiagnosticStatus";
  static constexpr std::byte kOk{0}, kWarn{1}, kError{2}, kStale{3};
  std::byte level = kOk;
  std::string name;
  std::string message;
  std::string hardware_id;
  std::vector<KeyValue> values;

  template <typename Self, typename Visit>
  static void members(Self& m, Visit&& visit) {
    visit("level", m.level);
    visit("name", m.name);
    visit("message", m.message);
    visit("hardware_id", m.hardware_id);
    visit("values", m.values);
  }
};

struct DiagnosticArray {
  static constexpr const char* kType = "diagnostic_msgs/msg/DiagnosticArray";
  Header header;
  std::vector<DiagnosticStatus> status;

  template <typename Self, typename Visit>
  static void members(Self& m, Visit&& visit) {
    visit("header", m.header);
    visit("status", m.status);
  }
};

struct CompressedImage {
  static constexpr const char* kType = "sensor_msgs/msg/CompressedImage";
  Header header;
  std::string format;
  std::vector<std::uint8_t> data;

  template <typename Self, typename Visit>
  static void members(Self& m, Visit&& visit) {
    visit("header", m.header);
    visit("format", m.format);
    visit("data", m.data);
  }
};

struct UVCoordinate {
  static constexpr const char* kType = "visualization_msgs/msg/UVCoordinate";
  float u = 0, v = 0;

  template <typename Self, typename Visit>
  static void members(Self& m, Visit&& visit) {
    visit("u", m.u);
    visit("v", m.v);
  }
};

struct MeshFile {
  static constexpr const char* kType = "visualization_msgs/msg/MeshFile";
  std::string filename;
  std::vector<std::uint8_t> data;

  template <typename Self, typename Visit>
  static void members(Self& m, Visit&& visit) {
    visit("filename", m.filename);
    visit("data", m.data);
  }
};

/// A shape to draw, known by `ns` and `id`; one with the same replaces it.
struct Marker {
  static constexpr const char* kType = "visualization_msgs/msg/Marker";
  static constexpr std::int32_t kCube = 1, kSphere = 2, kCylinder = 3, kTriangleList = 11;  // of type; all about their own origin
  static constexpr std::int32_t kAdd = 0;                                                   // of action
  Header header;
  std::string ns;
  std::int32_t id = 0;
  std::int32_t type = kCube;
  std::int32_t action = kAdd;
  Pose pose;
  Vector3 scale;  ///< size along its own axes, diameters for round ones
  ColorRGBA color;
  Duration lifetime;  ///< it goes by itself after this; 0: never
  bool frame_locked = false;
  std::vector<Point> points;  ///< of kTriangleList: three for each
  std::vector<ColorRGBA> colors;
  std::string texture_resource;
  CompressedImage texture;
  std::vector<UVCoordinate> uv_coordinates;
  std::string text;
  std::string mesh_resource;
  MeshFile mesh_file;
  bool mesh_use_embedded_materials = false;

  template <typename Self, typename Visit>
  static void members(Self& m, Visit&& visit) {
    visit("header", m.header);
    visit("ns", m.ns);
    visit("id", m.id);
    visit("type", m.type);
    visit("action", m.action);
    visit("pose", m.pose);
    visit("scale", m.scale);
    visit("color", m.color);
    visit("lifetime", m.lifetime);
    visit("frame_locked", m.frame_locked);
    visit("points", m.points);
    visit("colors", m.colors);
    visit("texture_resource", m.texture_resource);
    visit("texture", m.texture);
    visit("uv_coordinates", m.uv_coordinates);
    visit("text", m.text);
    visit("mesh_resource", m.mesh_resource);
    visit("mesh_file", m.mesh_file);
    visit("mesh_use_embedded_materials", m.mesh_use_embedded_materials);
  }
};

struct MarkerArray {
  static constexpr const char* kType = "visualization_msgs/msg/MarkerArray";
  std::vector<Marker> markers;

  template <typename Self, typename Visit>
  static void members(Self& m, Visit&& visit) {
    visit("markers", m.markers);
  }
};

}  // namespace interlace::ros2
