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
  private readonly waiting = new Map<number, (message: TextMessage) => void>();
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

  /** Sends a command and waits for its answer. */
  ask(command: Command): Promise<TextMessage> {
    return new Promise((resolve) => this.waiting.set(this.send(command), resolve));
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
      this.waiting.clear();
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
    const message = JSON.parse(String(data)) as TextMessage;
    if ((message.type === 'done' || message.type === 'error') && message.id !== undefined) {
      this.waiting.get(message.id)?.(message);
      this.waiting.delete(message.id);
    }
    this.listener.onText(message);
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
