/** The WebSocket to `cairn view`: sends commands, hands on messages, joins again when the connection is lost. */
import { decodeFrame, decodeSamples, frameKind, sampleKind, type TextMessage } from './protocol';
import type { Frame, Sample } from './model';

export interface Listener {
  onText(message: TextMessage): void;
  onFrame(frame: Frame): void;
  onSamples(samples: Sample[]): void;
  onConnected(connected: boolean): void;
}

export type Command = { do: string } & Record<string, unknown>;

export class Connection {
  private socket: WebSocket | null = null;
  private nextId = 1;
  private retryDelay = 500;
  private ended = false;

  constructor(private readonly listener: Listener) {
    this.open();
  }

  /** Does nothing while the connection is lost: an old command would only surprise. @return its number */
  send(command: Command): number {
    const id = this.nextId++;
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify({ ...command, id }));
    return id;
  }

  /** Tells that a frame was drawn: the server sends only as many as the page can draw. */
  askForFrame(): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send('{"do":"next"}');
  }

  sendBytes(bytes: ArrayBuffer): void {
    this.socket?.send(bytes);
  }

  close(): void {
    this.ended = true;
    this.socket?.close();
  }

  private open(): void {
    const socket = new WebSocket(address('ws', '/ws'));
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => {
      this.retryDelay = 500;
      this.listener.onConnected(true);
    };
    socket.onmessage = (event) => this.receive(event.data);
    socket.onclose = () => {
      this.listener.onConnected(false);
      if (this.ended) return;
      setTimeout(() => this.open(), this.retryDelay);
      this.retryDelay = Math.min(5000, this.retryDelay * 1.6);
    };
    this.socket = socket;
  }

  private receive(data: unknown): void {
    if (data instanceof ArrayBuffer) {
      const kind = new DataView(data).getUint32(0, true);
      if (kind === frameKind) this.listener.onFrame(decodeFrame(data));
      if (kind === sampleKind) this.listener.onSamples(decodeSamples(data));
      return;
    }
    this.listener.onText(JSON.parse(String(data)) as TextMessage);
  }
}

/** An address of the server this page came from, with the token the page was opened with. */
export function address(scheme: 'http' | 'ws', path: string): string {
  const url = new URL(path, location.href);
  url.protocol = scheme === 'ws' ? 'ws:' : 'http:';
  const token = new URL(location.href).searchParams.get('token');
  if (token) url.searchParams.set('token', token);
  return url.href;
}
