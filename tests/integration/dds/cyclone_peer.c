/* A client of another vendor: CycloneDDS and the C types idlc makes from the same IDL. Shares no code with the rest.
 *
 *   cyclone_peer DOMAIN CELL ROBOT postures N TIMEOUT_S
 *       prints N postures: robot, joints, position.
 *   cyclone_peer DOMAIN CELL ROBOT command ID X Y Z QW QX QY QZ TIMEOUT_S
 *       submits a linear command (metres, world frame), again every second until it is answered, and prints its statuses until a final one.
 *
 * Exits 0 when all postures came or the command completed, 1 when not in time or it ended otherwise, 2 on a wrong call. */
#include <dds/dds.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "interlace.h"

enum { OK = 0, FAILED = 1, USAGE = 2 };

static const char* const kStates[] = {"queued", "waiting", "scheduled", "started", "completed", "rejected", "cancelled", "failed"};

static dds_entity_t must(dds_entity_t entity, const char* what) {
  if (entity < 0) {
    fprintf(stderr, "cyclone_peer: %s: %s\n", what, dds_strretcode(entity));
    exit(FAILED);
  }
  return entity;
}

/* QoS as in idl/README.md: reliable, plain CDR; state topics keep the last value for late readers. */
static dds_qos_t* make_qos(bool state) {
  static const dds_data_representation_id_t plain = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_durability(qos, state ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, state ? 1 : 256);
  dds_qset_data_representation(qos, 1, &plain);
  return qos;
}

struct peer {
  dds_entity_t participant;
  const char* cell;
  const char* robot;
};

static dds_entity_t make_topic(const struct peer* peer, const dds_topic_descriptor_t* type, const char* kind) {
  char name[256];
  snprintf(name, sizeof name, "%s/%s/%s", peer->cell, peer->robot, kind);
  return must(dds_create_topic(peer->participant, type, name, NULL, NULL), name);
}

static dds_entity_t make_reader(const struct peer* peer, const dds_topic_descriptor_t* type, const char* kind, bool state) {
  dds_qos_t* qos = make_qos(state);
  const dds_entity_t reader = must(dds_create_reader(peer->participant, make_topic(peer, type, kind), qos, NULL), "reader");
  dds_delete_qos(qos);
  return reader;
}

static dds_entity_t make_writer(const struct peer* peer, const dds_topic_descriptor_t* type, const char* kind) {
  dds_qos_t* qos = make_qos(false);
  const dds_entity_t writer = must(dds_create_writer(peer->participant, make_topic(peer, type, kind), qos, NULL), "writer");
  dds_delete_qos(qos);
  return writer;
}

/* A waitset that triggers while `reader` holds samples. */
static dds_entity_t wait_for_data(const struct peer* peer, dds_entity_t reader) {
  const dds_entity_t set = must(dds_create_waitset(peer->participant), "waitset");
  const dds_entity_t any = must(dds_create_readcondition(reader, DDS_ANY_STATE), "condition");
  must(dds_waitset_attach(set, any, 0), "attach");
  return set;
}

static int read_postures(const struct peer* peer, int wanted, dds_time_t deadline) {
  const dds_entity_t reader = make_reader(peer, &interlace_Posture_desc, "posture", true);
  const dds_entity_t set = wait_for_data(peer, reader);
  int seen = 0;
  while (seen < wanted && dds_time() < deadline) {
    dds_waitset_wait_until(set, NULL, 0, deadline);
    void* sample = NULL;
    dds_sample_info_t info;
    while (seen < wanted && dds_take(reader, &sample, &info, 1, 1) == 1) {
      const interlace_Posture* p = sample;
      if (info.valid_data && p->version == interlace_PROTOCOL_VERSION) {
        ++seen;
        printf("%s joints %.6f %.6f %.6f %.6f %.6f %.6f position %.6f %.6f %.6f%s\n", p->robot, p->joints[0], p->joints[1], p->joints[2],
               p->joints[3], p->joints[4], p->joints[5], p->position.x, p->position.y, p->position.z, p->moving ? " moving" : "");
      }
      dds_return_loan(reader, &sample, 1);
    }
  }
  if (seen < wanted) fprintf(stderr, "cyclone_peer: %d of %d postures\n", seen, wanted);
  return seen == wanted ? OK : FAILED;
}

/* Prints what came about command `id`; true once its state is final, which is then in *last. */
static bool take_statuses(dds_entity_t reader, const char* id, bool* answered, interlace_CommandState* last) {
  bool final = false;
  void* sample = NULL;
  dds_sample_info_t info;
  while (dds_take(reader, &sample, &info, 1, 1) == 1) {
    const interlace_CommandStatus* s = sample;
    if (info.valid_data && s->version == interlace_PROTOCOL_VERSION && strcmp(s->id, id) == 0) {
      *answered = true;
      *last = s->state;
      final = final || s->state >= interlace_STATE_COMPLETED;
      printf("%s %s %s\n", s->id, kStates[s->state], s->text);
    }
    dds_return_loan(reader, &sample, 1);
  }
  return final;
}

static bool matched(dds_entity_t reader, dds_entity_t writer) {
  dds_subscription_matched_status_t subscribed;
  dds_publication_matched_status_t published;
  return dds_get_subscription_matched_status(reader, &subscribed) == DDS_RETCODE_OK && subscribed.current_count > 0 &&
         dds_get_publication_matched_status(writer, &published) == DDS_RETCODE_OK && published.current_count > 0;
}

/* Waits until a planner listens to the command and its answers can come back. */
static bool wait_for_planner(const struct peer* peer, dds_entity_t reader, dds_entity_t writer, dds_time_t deadline) {
  const dds_entity_t set = must(dds_create_waitset(peer->participant), "waitset");
  must(dds_set_status_mask(reader, DDS_SUBSCRIPTION_MATCHED_STATUS), "status mask");
  must(dds_set_status_mask(writer, DDS_PUBLICATION_MATCHED_STATUS), "status mask");
  must(dds_waitset_attach(set, reader, 0), "attach");
  must(dds_waitset_attach(set, writer, 0), "attach");
  while (!matched(reader, writer)) {
    if (dds_time() >= deadline) return false;
    dds_waitset_wait_until(set, NULL, 0, deadline);
  }
  return true;
}

static int submit(const struct peer* peer, const char* id, char** pose, dds_time_t deadline) {
  const dds_entity_t reader = make_reader(peer, &interlace_CommandStatus_desc, "command_status", false);
  const dds_entity_t writer = make_writer(peer, &interlace_Command_desc, "command");
  if (!wait_for_planner(peer, reader, writer, deadline)) {
    fprintf(stderr, "cyclone_peer: no planner listens\n");
    return FAILED;
  }
  interlace_Command command;
  memset(&command, 0, sizeof command);
  command.version = interlace_PROTOCOL_VERSION;
  command.kind = interlace_COMMAND_LINEAR;
  snprintf(command.id, sizeof command.id, "%s", id);
  snprintf(command.robot, sizeof command.robot, "%s", peer->robot);
  snprintf(command.client, sizeof command.client, "cyclone_peer");
  command.has_deadline = true;
  command.deadline = 3600;
  command.motion.position.x = atof(pose[0]);
  command.motion.position.y = atof(pose[1]);
  command.motion.position.z = atof(pose[2]);
  command.motion.orientation.w = atof(pose[3]);
  command.motion.orientation.x = atof(pose[4]);
  command.motion.orientation.y = atof(pose[5]);
  command.motion.orientation.z = atof(pose[6]);

  const dds_entity_t set = wait_for_data(peer, reader);
  bool answered = false;
  interlace_CommandState last = interlace_STATE_QUEUED;
  dds_time_t next_try = 0;
  while (dds_time() < deadline) {
    if (!answered && dds_time() >= next_try) {
      must(dds_write(writer, &command), "write");
      next_try = dds_time() + DDS_SECS(1);
    }
    dds_waitset_wait_until(set, NULL, 0, answered || next_try > deadline ? deadline : next_try);
    if (take_statuses(reader, id, &answered, &last)) return last == interlace_STATE_COMPLETED ? OK : FAILED;
  }
  fprintf(stderr, "cyclone_peer: %s\n", answered ? "the command did not end in time" : "no answer");
  return FAILED;
}

int main(int argc, char** argv) {
  const bool postures = argc == 7 && strcmp(argv[4], "postures") == 0;
  const bool command = argc == 14 && strcmp(argv[4], "command") == 0;
  if (!postures && !command) {
    fprintf(stderr,
            "usage: cyclone_peer DOMAIN CELL ROBOT postures N TIMEOUT_S\n"
            "       cyclone_peer DOMAIN CELL ROBOT command ID X Y Z QW QX QY QZ TIMEOUT_S\n");
    return USAGE;
  }
  const dds_time_t deadline = dds_time() + (dds_time_t)(atof(argv[argc - 1]) * 1e9);
  struct peer peer = {0, argv[2], argv[3]};
  peer.participant = must(dds_create_participant((dds_domainid_t)strtoul(argv[1], NULL, 10), NULL, NULL), "participant");
  const int outcome = postures ? read_postures(&peer, atoi(argv[5]), deadline) : submit(&peer, argv[5], argv + 6, deadline);
  dds_delete(peer.participant);
  return outcome;
}
