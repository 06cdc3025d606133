/* What a ROS 2 tool would see of a cell: CycloneDDS and the C types idlc makes from idl/ros2.idl, under ROS 2's names. Shares no code with
 * the rest.
 *
 *   ros2_peer DOMAIN NAMESPACE TIMEOUT_S
 *       prints every message that comes on the topics of that namespace and on /tf, /tf_static and /diagnostics, one a line, and for each
 *       writer once its topic, type and user data. Ends after the time, with 0; 2 on a wrong call. */
#include <dds/dds.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ros2.h"

enum { OK = 0, FAILED = 1, USAGE = 2 };

static dds_entity_t must(dds_entity_t entity, const char* what) {
  if (entity < 0) {
    fprintf(stderr, "ros2_peer: %s: %s\n", what, dds_strretcode(entity));
    exit(FAILED);
  }
  return entity;
}

static void print_joint_states(const char* topic, const void* sample) {
  const sensor_msgs_msg_dds__JointState_* m = sample;
  printf("%s at %d", topic, m->header.stamp.sec);
  for (uint32_t i = 0; i < m->name._length && i < m->position._length; ++i) printf(" %s=%.6f", m->name._buffer[i], m->position._buffer[i]);
  printf(" velocities %u efforts %u\n", m->velocity._length, m->effort._length);
}

static void print_string(const char* topic, const void* sample) {
  const std_msgs_msg_dds__String_* m = sample;
  printf("%s of %zu bytes: %s\n%s ends\n", topic, strlen(m->data), m->data, topic);
}

static void print_markers(const char* topic, const void* sample) {
  const visualization_msgs_msg_dds__MarkerArray_* m = sample;
  printf("%s %u:", topic, m->markers._length);
  for (uint32_t i = 0; i < m->markers._length; ++i) {
    const visualization_msgs_msg_dds__Marker_* k = &m->markers._buffer[i];
    printf(" [%s %d in %s type %d at %.4f %.4f %.4f size %.4f %.4f %.4f colour %.2f %.2f %.2f %.2f points %u lifetime %d]", k->ns, k->id,
           k->header.frame_id, k->type, k->pose.position.x, k->pose.position.y, k->pose.position.z, k->scale.x, k->scale.y, k->scale.z,
           k->color.r, k->color.g, k->color.b, k->color.a, k->points._length, k->lifetime.sec);
  }
  printf("\n");
}

static void print_frames(const char* topic, const void* sample) {
  const tf2_msgs_msg_dds__TFMessage_* m = sample;
  printf("%s %u:", topic, m->transforms._length);
  for (uint32_t i = 0; i < m->transforms._length; ++i) {
    const geometry_msgs_msg_dds__TransformStamped_* t = &m->transforms._buffer[i];
    printf(" [%s in %s at %.4f %.4f %.4f turned %.4f %.4f %.4f %.4f]", t->child_frame_id, t->header.frame_id, t->transform.translation.x,
           t->transform.translation.y, t->transform.translation.z, t->transform.rotation.x, t->transform.rotation.y,
           t->transform.rotation.z, t->transform.rotation.w);
  }
  printf("\n");
}

static void print_diagnostics(const char* topic, const void* sample) {
  const diagnostic_msgs_msg_dds__DiagnosticArray_* m = sample;
  printf("%s at %d:", topic, m->header.stamp.sec);
  for (uint32_t i = 0; i < m->status._length; ++i) {
    const diagnostic_msgs_msg_dds__DiagnosticStatus_* s = &m->status._buffer[i];
    printf(" [%d %s | %s | %s |", s->level, s->name, s->hardware_id, s->message);
    for (uint32_t k = 0; k < s->values._length; ++k) printf(" %s=%s", s->values._buffer[k].key, s->values._buffer[k].value);
    printf("]");
  }
  printf("\n");
}

struct stream {
  const char* name; /* with a '/' before it: not below the namespace */
  const dds_topic_descriptor_t* type;
  bool latched;
  void (*print)(const char* topic, const void* sample);
  dds_entity_t reader;
  bool introduced;
};

/* As ROS 2 nodes ask by default: reliable, the last ten; the last one alone, also when it came before, where that is usual. */
static void open_stream(struct stream* stream, dds_entity_t participant, const char* ns) {
  char name[256];
  snprintf(name, sizeof name, "rt/%s%s%s", *stream->name == '/' ? "" : ns, *stream->name == '/' ? "" : "/",
           *stream->name == '/' ? stream->name + 1 : stream->name);
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_durability(qos, stream->latched ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, stream->latched ? 1 : 10);
  const dds_entity_t topic = must(dds_create_topic(participant, stream->type, name, NULL, NULL), name);
  stream->reader = must(dds_create_reader(participant, topic, qos, NULL), name);
  dds_delete_qos(qos);
}

static void introduce(struct stream* stream) {
  dds_instance_handle_t writer = 0;
  if (stream->introduced || dds_get_matched_publications(stream->reader, &writer, 1) < 1) return;
  dds_builtintopic_endpoint_t* data = dds_get_matched_publication_data(stream->reader, writer);
  if (data == NULL) return;
  void* bytes = NULL;
  size_t size = 0;
  dds_qget_userdata(data->qos, &bytes, &size);
  printf("writer of %s type %s user data %.*s\n", data->topic_name, data->type_name, (int)size, (const char*)bytes);
  dds_free(bytes);
  dds_builtintopic_free_endpoint(data);
  stream->introduced = true;
}

static void take(struct stream* stream) {
  void* sample = NULL;
  dds_sample_info_t info;
  while (dds_take(stream->reader, &sample, &info, 1, 1) == 1) {
    if (info.valid_data) stream->print(stream->name, sample);
    dds_return_loan(stream->reader, &sample, 1);
  }
}

int main(int argc, char** argv) {
  if (argc != 4) {
    fprintf(stderr, "usage: ros2_peer DOMAIN NAMESPACE TIMEOUT_S\n");
    return USAGE;
  }
  struct stream streams[] = {
      {"joint_states", &sensor_msgs_msg_dds__JointState__desc, false, print_joint_states, 0, false},
      {"robot_description", &std_msgs_msg_dds__String__desc, true, print_string, 0, false},
      {"capsules", &visualization_msgs_msg_dds__MarkerArray__desc, false, print_markers, 0, false},
      {"fixtures", &visualization_msgs_msg_dds__MarkerArray__desc, true, print_markers, 0, false},
      {"/tf", &tf2_msgs_msg_dds__TFMessage__desc, false, print_frames, 0, false},
      {"/tf_static", &tf2_msgs_msg_dds__TFMessage__desc, true, print_frames, 0, false},
      {"/diagnostics", &diagnostic_msgs_msg_dds__DiagnosticArray__desc, false, print_diagnostics, 0, false},
  };
  const size_t count = sizeof streams / sizeof streams[0];
  const dds_time_t deadline = dds_time() + (dds_time_t)(atof(argv[3]) * 1e9);
  const dds_entity_t participant = must(dds_create_participant((dds_domainid_t)strtoul(argv[1], NULL, 10), NULL, NULL), "participant");
  const dds_entity_t set = must(dds_create_waitset(participant), "waitset");
  for (size_t i = 0; i < count; ++i) {
    open_stream(&streams[i], participant, argv[2]);
    must(dds_set_status_mask(streams[i].reader, DDS_DATA_AVAILABLE_STATUS | DDS_SUBSCRIPTION_MATCHED_STATUS), "status mask");
    must(dds_waitset_attach(set, streams[i].reader, 0), "attach");
  }
  while (dds_time() < deadline) {
    dds_waitset_wait_until(set, NULL, 0, deadline);
    for (size_t i = 0; i < count; ++i) {
      dds_subscription_matched_status_t matched;
      (void)dds_get_subscription_matched_status(streams[i].reader, &matched);
      introduce(&streams[i]);
      take(&streams[i]);
    }
    fflush(stdout);
  }
  dds_delete(participant);
  return OK;
}
