// Starts `plutoc lsp` and opens the graph. All that is known of the language, the server knows.

const { commands, tasks, window, workspace } = require("vscode");
const { ShellExecution, Task, TaskScope, TaskRevealKind, TaskPanelKind } = require("vscode");
const { LanguageClient, State } = require("vscode-languageclient/node");

const DOCUMENTS = [{ language: "pluto" }, { scheme: "file", pattern: "**/hooks.py" }];

let client;

const settings = () => workspace.getConfiguration("pluto");

function started() {
  const command = settings().get("path");
  const made = new LanguageClient(
    "pluto",
    "Pluto",
    { command, args: ["lsp"] },
    {
      documentSelector: DOCUMENTS,
      initializationOptions: { showsPages: true },
      middleware: {
        provideInlayHints: (document, range, token, next) =>
          settings().get("inlayHints") ? next(document, range, token) : [],
        executeCommand: explained,
      },
    },
  );
  made.start().catch(() => {
    window.showErrorMessage(
      `Pluto: ${command} lsp cannot be started. Is it installed? pip install "plutoc[editor]"` +
        " (the setting pluto.path says where it is)",
    );
  });
  return made;
}

/** The page of a code is shown as it is read, not as it is written. */
async function explained(command, given, next) {
  if (command !== "pluto.explain") return next(command, given);
  const text = await next(command, given);
  const document = await workspace.openTextDocument({ language: "markdown", content: text });
  return commands.executeCommand("markdown.showPreviewToSide", document.uri);
}

/** `plutoc edit FILE` opens the browser by itself; it runs until its terminal is closed. */
async function openGraph(uri) {
  const document = uri ? await workspace.openTextDocument(uri) : window.activeTextEditor?.document;
  if (document?.languageId !== "pluto") return;
  if (document.isUntitled || (document.isDirty && !(await document.save()))) {
    window.showInformationMessage("Pluto: save the app first; the graph is a view of its file.");
    return;
  }
  const run = new ShellExecution(settings().get("path"), ["edit", document.uri.fsPath]);
  const name = `graph of ${document.uri.path.split("/").pop()}`;
  const task = new Task({ type: "pluto" }, TaskScope.Workspace, name, "pluto", run);
  task.isBackground = true;
  task.presentationOptions = { reveal: TaskRevealKind.Silent, panel: TaskPanelKind.Dedicated };
  await tasks.executeTask(task);
}

async function restart() {
  if (client?.state === State.Running) await client.stop();
  client = started();
}

exports.activate = (context) => {
  client = started();
  context.subscriptions.push(
    commands.registerCommand("pluto.openGraph", openGraph),
    commands.registerCommand("pluto.restart", restart),
    workspace.onDidChangeConfiguration((change) => {
      if (change.affectsConfiguration("pluto")) restart();
    }),
  );
};

exports.deactivate = () => (client?.state === State.Running ? client.stop() : undefined);
