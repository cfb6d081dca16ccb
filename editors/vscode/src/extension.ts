// Starts `lipz lsp` for Lipz files and the settings of their projects.

import { commands, type ExtensionContext, window, workspace } from "vscode";
import { LanguageClient, type LanguageClientOptions, type ServerOptions } from "vscode-languageclient/node";

let client: LanguageClient | undefined;

/** The client of the program that the settings name. */
function newClient(): LanguageClient {
  const command = workspace.getConfiguration("lipz").get<string>("command") || "lipz";
  const server: ServerOptions = { command, args: ["lsp"] };
  const options: LanguageClientOptions = {
    documentSelector: [
      { scheme: "file", language: "lipz" },
      { scheme: "untitled", language: "lipz" },
      { scheme: "file", pattern: "**/lipz.toml" },
    ],
    // Hovers show pictures of mouths.
    initializationOptions: { pictures: true },
  };
  return new LanguageClient("lipz", "Lipz", server, options);
}

async function start(): Promise<void> {
  client = newClient();
  try {
    await client.start();
  } catch (error) {
    const why = error instanceof Error ? error.message : String(error);
    const settings = "Open Settings";
    const chosen = await window.showErrorMessage(`The program lipz cannot be run: ${why}. Is \`lipz.command\` its path?`, settings);
    if (chosen === settings) await commands.executeCommand("workbench.action.openSettings", "lipz.command");
  }
}

async function stop(): Promise<void> {
  const running = client;
  client = undefined;
  if (running?.isRunning()) await running.stop();
}

async function restart(): Promise<void> {
  await stop();
  await start();
}

export async function activate(context: ExtensionContext): Promise<void> {
  context.subscriptions.push(
    commands.registerCommand("lipz.restart", restart),
    workspace.onDidChangeConfiguration(async (event) => {
      if (event.affectsConfiguration("lipz.command")) await restart();
    }),
  );
  await start();
}

export const deactivate = stop;
