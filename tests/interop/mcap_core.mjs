// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
//
// The other side of mcap_core_test: the npm package @mcap/core, from the folder $VERGE_NODE_MODULES.
//
//   node mcap_core.mjs read FILE       one line a message: TOPIC TYPE LOG_TIME SIZE CRC32, and of a PointCloud2 also
//                                      STAMP FRAME WIDTH POINT_STEP FIELDS; by the index, then, as "stream", in order
//   node mcap_core.mjs write FILE KIND clouds of 1, 2, 3, 4 points; KIND: none, lz4, unchunked, bare (no summary)
import { createRequire } from "node:module";
import { promises as fs, readFileSync } from "node:fs";
import path from "node:path";

const require = createRequire(path.join(process.env.VERGE_NODE_MODULES, "from-here.js"));
const { McapIndexedReader, McapStreamReader, McapWriter } = require("@mcap/core");
const { MessageReader, MessageWriter } = require("@foxglove/rosmsg2-serialization");
const { parse } = require("@foxglove/rosmsg");
const { crc32 } = require("@foxglove/crc");
const lz4 = require("lz4js");
const zstd = require("fzstd");

const decompressHandlers = {
  lz4: (data) => new Uint8Array(lz4.decompress(data)),
  zstd: (data) => zstd.decompress(data),
};

const text = (bytes) => new TextDecoder().decode(bytes);

function line(schema, channel, message) {
  const words = [channel.topic, schema.name, message.logTime, message.data.byteLength, crc32(message.data)];
  const reader = new MessageReader(parse(text(schema.data), { ros2: true }));
  const value = reader.readMessage(message.data);
  if (schema.name === "sensor_msgs/msg/PointCloud2") {
    const { sec, nanosec } = value.header.stamp;
    words.push(BigInt(sec) * 1_000_000_000n + BigInt(nanosec), value.header.frame_id, value.width, value.point_step);
    words.push(value.fields.map((field) => `${field.name}:${field.offset}:${field.datatype}`).join(","));
  }
  return words.join(" ");
}

async function readByIndex(bytes) {
  const readable = {
    size: async () => BigInt(bytes.byteLength),
    read: async (offset, size) => bytes.subarray(Number(offset), Number(offset + size)),
  };
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  const lines = [];
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    const channel = reader.channelsById.get(message.channelId);
    lines.push(line(reader.schemasById.get(channel.schemaId), channel, message));
  }
  if (reader.statistics.messageCount !== BigInt(lines.length)) throw new Error("statistics are wrong");
  return lines;
}

function readInOrder(bytes) {
  const reader = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  reader.append(bytes);
  const schemas = new Map();
  const channels = new Map();
  const lines = [];
  for (let record; (record = reader.nextRecord()) != undefined; ) {
    if (record.type === "Schema") schemas.set(record.id, record);
    if (record.type === "Channel") channels.set(record.id, record);
    if (record.type !== "Message") continue;
    const channel = channels.get(record.channelId);
    lines.push(line(schemas.get(channel.schemaId), channel, record));
  }
  if (!reader.done()) throw new Error("the end is missing");
  return lines;
}

const definition = `std_msgs/Header header
uint32 height
uint32 width
sensor_msgs/PointField[] fields
bool is_bigendian
uint32 point_step
uint32 row_step
uint8[] data
bool is_dense
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
================================================================================
MSG: sensor_msgs/PointField
string name
uint32 offset
uint8 datatype
uint32 count
`;

function cloud(points) {
  const data = new DataView(new ArrayBuffer(16 * points));
  for (let i = 0; i < points; ++i) {
    [i + 1, 2, 3].forEach((value, k) => data.setFloat32(16 * i + 4 * k, value, true));
    data.setUint16(16 * i + 12, i % 4, true);
  }
  const float = (name, offset) => ({ name, offset, datatype: 7, count: 1 });
  return {
    header: { stamp: { sec: 1_700_000_000, nanosec: points }, frame_id: "lidar" },
    height: 1,
    width: points,
    fields: [float("x", 0), float("y", 4), float("z", 8), { name: "ring", offset: 12, datatype: 4, count: 1 }],
    is_bigendian: false,
    point_step: 16,
    row_step: 16 * points,
    data: new Uint8Array(data.buffer),
    is_dense: true,
  };
}

async function write(file, kind) {
  const handle = await fs.open(file, "w");
  let position = 0n;
  const writable = {
    position: () => position,
    write: async (bytes) => {
      await handle.write(bytes);
      position += BigInt(bytes.byteLength);
    },
  };
  const bare = kind === "bare";
  const none = { useStatistics: false, useSummaryOffsets: false, repeatSchemas: false, repeatChannels: false, useChunkIndex: false };
  const writer = new McapWriter({
    writable,
    useChunks: kind !== "unchunked",
    chunkSize: 200,
    ...(bare ? none : {}),
    ...(kind === "lz4"
      ? { compressChunk: (data) => ({ compression: "lz4", compressedData: new Uint8Array(lz4.compress(data)) }) }
      : {}),
  });
  await writer.start({ profile: "ros2", library: "" });
  const encoder = new TextEncoder();
  const schemaId = await writer.registerSchema({
    name: "sensor_msgs/msg/PointCloud2",
    encoding: "ros2msg",
    data: encoder.encode(definition),
  });
  const channelId = await writer.registerChannel({ schemaId, topic: "/points", messageEncoding: "cdr", metadata: new Map() });
  const messages = new MessageWriter(parse(definition, { ros2: true }));
  for (let points = 1; points <= 4; ++points) {
    const logTime = 1_700_000_000_000_000_000n + BigInt(points);
    await writer.addMessage({ channelId, sequence: points, logTime, publishTime: logTime, data: messages.writeMessage(cloud(points)) });
  }
  await writer.end();
  await handle.close();
}

const [verb, file, kind] = process.argv.slice(2);
if (verb === "write") {
  await write(file, kind);
} else {
  const bytes = new Uint8Array(readFileSync(file));
  for (const words of await readByIndex(bytes)) console.log(words);
  console.log("stream");
  for (const words of readInOrder(bytes)) console.log(words);
}
