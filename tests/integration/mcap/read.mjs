// Reads a recording with @mcap/core and @foxglove/rosmsg2-serialization and prints one line for each message, in the order of the file:
// topic, log time, publish time, type and some fields; doubles as their bits. Then the number of messages that the indexed reader finds.
// A recording that was cut off has no index: --stream leaves that out. --bytes prints of each message instead its topic, its number on that
// topic and its bytes.
import { open, readFile } from "node:fs/promises";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";

const bits = (number) => {
  const view = new DataView(new ArrayBuffer(8));
  view.setFloat64(0, number);
  return view.getBigUint64(0).toString(16).padStart(16, "0");
};

const told = {
  "interlace/msg/Command": (m) => [m.version, m.kind, m.id, m.robot, bits(m.motion.position.x)],
  "interlace/msg/CommandStatus": (m) => [m.version, m.id, m.state, m.reason, m.submitted, bits(m.delay), m.conflicts.length, m.text],
  "interlace/msg/Dispatch": (m) => [m.version, m.kind, m.robot, m.id, m.earliest, bits(m.duration)],
  "interlace/msg/Execution": (m) => [m.version, m.id, m.state, m.at, bits(m.joints[5])],
  "interlace/msg/Posture": (m) => [m.version, m.robot, m.at, ...Array.from(m.joints, bits), bits(m.position.x), m.moving, m.motion],
  "interlace/msg/PlannerState": (m) => [m.version, m.cell, m.at, m.strategy, m.robots.map((r) => r.name).join(","), m.completed],
  "interlace/msg/PlannerJournal": (m) => [m.version, m.first, m.calls.length, m.calls.at(-1)?.now, m.calls.at(-1)?.digest],
};

const [file, mode] = process.argv.slice(2);
const stream = new McapStreamReader();
stream.append(await readFile(file));
const schemas = new Map();
const channels = new Map();
const lines = [];
for (let record; (record = stream.nextRecord()); ) {
  if (record.type === "Schema") {
    const text = new TextDecoder().decode(record.data);
    schemas.set(record.id, { name: record.name, reader: new MessageReader(parse(text, { ros2: true })) });
  } else if (record.type === "Channel") {
    channels.set(record.id, record);
  } else if (record.type === "Message") {
    const channel = channels.get(record.channelId);
    if (mode === "--bytes") {
      lines.push(`${channel.topic} ${record.sequence} ${Buffer.from(record.data).toString("hex")}`);
      continue;
    }
    const { name, reader } = schemas.get(channel.schemaId);
    const message = reader.readMessage(record.data);
    lines.push([channel.topic, record.logTime, record.publishTime, name, ...told[name](message)].join(" "));
  }
}

if (!mode) {
  const handle = await open(file);
  const readable = {
    size: async () => BigInt((await handle.stat()).size),
    read: async (offset, length) => {
      const buffer = new Uint8Array(Number(length));
      await handle.read(buffer, 0, buffer.length, Number(offset));
      return buffer;
    },
  };
  const indexed = await McapIndexedReader.Initialize({ readable });
  let count = 0n;
  for await (const message of indexed.readMessages()) count += message.data.length > 4 ? 1n : 0n;
  await handle.close();
  lines.push(`indexed ${count} ${indexed.statistics.messageCount}`);
}
process.stdout.write(lines.join("\n") + "\n");
