/** Begins: an exported file plays its clip, a served page asks the server what to show. */
import { App } from './app';
import { decodeClip, embeddedClip, type Clip } from './clip';
import { address, Connection } from './connection';
import { makeFilm } from './film';
import { Live } from './live';
import type { Hello, TextMessage } from './protocol';
import { Replay } from './replay';

declare global {
  interface Window {
    /** for tests and the curious: what the page shows */
    cairn?: { app?: App; live?: Live; replay?: Replay };
  }
}

const root = document.getElementById('app')!;
window.cairn = {};

async function fetchClip(index: number): Promise<Clip> {
  const response = await fetch(address('http', `/recording/${index}`));
  if (!response.ok) throw new Error(`The recording could not be loaded: ${response.statusText}`);
  return decodeClip(await response.blob());
}

function showReplay(app: App, clips: Clip[], names: string[]): void {
  const replay = new Replay(app, clips, names);
  window.cairn!.replay = replay;
  app.start(replay);
}

function serve(): void {
  let app: App | null = null;
  let live: Live | null = null;
  let onTaken: (() => void) | null = null;
  const waiting: TextMessage[] = [];
  const begin = async (hello: Hello): Promise<void> => {
    if (hello.mode === 'film') {
      const taken = (): Promise<void> => new Promise((resolve) => { onTaken = resolve; });
      await makeFilm(root, await fetchClip(0), hello.film!, connection, taken).catch((error: unknown) =>
        connection.send({ do: 'failed', text: String(error) }));
      return;
    }
    app = new App(root);
    window.cairn!.app = app;
    if (hello.mode === 'replay') {
      showReplay(app, await Promise.all(hello.recordings.map((_, i) => fetchClip(i))), hello.recordings);
      return;
    }
    live = new Live(app, connection, hello);
    window.cairn!.live = live;
    app.start(live);
    for (const message of waiting) live.onText(message);
  };
  const connection = new Connection({
    onText: (message) => {
      if (message.type === 'next-picture') onTaken?.();
      else if (message.type === 'hello' && !app) begin(message).catch(fail);
      else if (live) live.onText(message);
      else waiting.push(message);
    },
    onFrame: (frame) => live?.onFrame(frame),
    onSamples: (samples) => live?.onSamples(samples),
    onConnected: (connected) => {
      document.body.classList.toggle('lost', !connected);
      if (!connected && live) app?.shell.say('The connection to cairn view is lost; trying again.', 'error');
    },
  });
}

function fail(error: unknown): void {
  const text = document.createElement('p');
  text.className = 'failure';
  text.textContent = error instanceof Error ? error.message : String(error);
  root.replaceChildren(text);
}

const clip = embeddedClip();
if (clip) {
  decodeClip(clip).then((decoded) => {
    const app = new App(root);
    window.cairn!.app = app;
    showReplay(app, [decoded], [decoded.header.title]);
  }).catch(fail);
} else {
  serve();
}
